// SPDX-License-Identifier: MIT
#define JETLAG_INSTRUCTION_SET_NAME sse2
#include "ensembles/ensemble_lanes.hpp"
