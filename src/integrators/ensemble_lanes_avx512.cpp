// SPDX-License-Identifier: MIT
#define JETLAG_INSTRUCTION_SET_NAME avx512
#include "integrators/ensemble_lanes.hpp"
