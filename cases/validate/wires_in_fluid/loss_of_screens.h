#pragma once
// Pressure loss of screens of round wire, K = dp / (1/2 rho U^2) with U the velocity of the approach.

namespace lahar::validate {

/// K = beta(Re) (1 - a^2)/a^2, a = 1 - solidity, with beta of screen_net.csv (Blevins 1984), between the tabulated
/// Reynolds numbers by the logarithm. Trusted to 20 %. Re is taken with the wire's diameter: only then is K -> Cd S for
/// a wide screen (2 beta is within 10 % of Cd from Re = 40 on, 25 % at 20).
double loss_of_screen(double solidity, double reynolds);

}  // namespace lahar::validate
