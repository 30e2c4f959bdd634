// SPDX-License-Identifier: MIT
// The register of methods. To add one, write its record in a file of this folder and name it twice here.
#include "scenes/methods/methods.hpp"

namespace jetlag {

namespace methods {

MethodRecord taylor(), random_taylor(), leapfrog(), avi(), subcycling(), qss1(), qss2(), qss3(),
    symplectic_euler(), euler(), rk4(), dopri5(), dop853(), gauss_radau(), hermite(), implicit_midpoint(),
    newmark(), explicit_implicit(), implicit_subcycling(), conrad(), random_step(), exponential_step(),
    block(), asynchronous();

}  // namespace methods

const std::vector<MethodRecord>& method_records() {
  using namespace methods;
  static const std::vector<MethodRecord> records = {taylor(),
                                                    random_taylor(),
                                                    leapfrog(),
                                                    avi(),
                                                    subcycling(),
                                                    qss1(),
                                                    qss2(),
                                                    qss3(),
                                                    symplectic_euler(),
                                                    methods::euler(),
                                                    methods::rk4(),
                                                    methods::dopri5(),
                                                    methods::dop853(),
                                                    gauss_radau(),
                                                    hermite(),
                                                    implicit_midpoint(),
                                                    newmark(),
                                                    explicit_implicit(),
                                                    implicit_subcycling(),
                                                    conrad(),
                                                    random_step(),
                                                    exponential_step(),
                                                    block(),
                                                    asynchronous()};
  return records;
}

}  // namespace jetlag
