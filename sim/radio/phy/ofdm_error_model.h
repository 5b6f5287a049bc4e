#pragma once

#include "sim/radio/phy/coding.h"

namespace sim::radio {

/// Probability that all of `bits` bits sent by OFDM in this coding arrive when the SINR is the same
/// for all of them: additive white noise, coherent demodulation with hard decisions, and the union
/// bound of the convolutional code with constraint length 7 and generators 133, 171 after G. Pei
/// and T. R. Henderson, "Validation of OFDM error rate model in ns-3", 2010 ("NIST" model). Weights
/// of the punctured codes: D. Haccoun and G. Begin, "High-rate punctured convolutional codes for
/// Viterbi and sequential decoding", IEEE Trans. Communications 37 (11), 1989.
/// 256-QAM and 1024-QAM by the same formula for square constellations.
/// @param sinr  of a subcarrier; a ratio, not dB; >= 0, may be infinite.
/// @param bits  >= 0; fractions count.
double ofdm_success_probability(double sinr, const Coding& coding, double bits);

}  // namespace sim::radio
