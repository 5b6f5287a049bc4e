#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gateway/process/domains.h"

namespace gateway::domain {
class Participant;
}

namespace gateway::inspection {

/// The DDS participant that standard tools can see: ordinary discovery by multicast, on the given
/// interfaces only. It does not discover the participants of the exchange, which neither send nor
/// receive multicast. A ShownDomain makes its domain known to `baraka topic`.
///
/// Inspectors and readers of topics use one and must not outlive it.
class InspectionParticipant {
 public:
  struct Settings {
    int domain = 0;  ///< 0..232
    /// IPv4 addresses of the interfaces to use.
    std::vector<std::string> addresses{"127.0.0.1"};
    std::string name = "baraka inspection";  ///< The participant's name in tools.
  };

  /// @throws std::runtime_error  if DDS cannot be opened on these interfaces.
  explicit InspectionParticipant(const Settings& settings);
  ~InspectionParticipant();
  InspectionParticipant(const InspectionParticipant&) = delete;
  InspectionParticipant& operator=(const InspectionParticipant&) = delete;

  int domain() const { return domain_; }
  domain::Participant& participant() { return *participant_; }  ///< For use within the gateway.

 private:
  int domain_;
  process::ShownDomain mark_;
  std::unique_ptr<domain::Participant> participant_;
};

}  // namespace gateway::inspection
