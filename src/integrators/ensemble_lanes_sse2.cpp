// SPDX-License-Identifier: MIT
#define JETLAG_INSTRUCTION_SET_NAME sse2
#include "integrators/ensemble_lanes.hpp"
