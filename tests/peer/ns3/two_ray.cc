// Gain of ns-3's two-ray ground at 2.412 GHz; prints CSV: heights of the antennas, m; m; dB.
#include <iomanip>
#include <iostream>

#include "wifi.h"

using namespace ns3;

int main() {
  const auto loss = CreateObject<TwoRayGroundPropagationLossModel>();
  loss->SetFrequency(2.412e9);
  loss->SetMinDistance(0.1);
  const auto from = CreateObject<ConstantPositionMobilityModel>();
  const auto to = CreateObject<ConstantPositionMobilityModel>();
  std::cout << "from_m,to_m,distance_m,gain_db\n" << std::setprecision(12);
  for (const auto& [first, second] :
       {std::pair{1.5, 1.5}, std::pair{0.5, 1.5}, std::pair{0.2, 0.2}}) {
    for (const double distance :
         {1., 3., 7., 20., 50., 75., 76., 100., 227., 228., 300., 1000., 5000.}) {
      from->SetPosition(Vector(0, 0, first));
      to->SetPosition(Vector(distance, 0, second));
      std::cout << first << ',' << second << ',' << distance << ','
                << loss->CalcRxPower(0, from, to) << '\n';
    }
  }
}
