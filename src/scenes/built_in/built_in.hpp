// SPDX-License-Identifier: MIT
#pragma once
// The scenes that come with the program, a file each.

#include "jetlag/scenes/scene.hpp"

namespace jetlag {

BuiltInScene body();
BuiltInScene ellipse();
BuiltInScene two_body();
BuiltInScene cloth();
BuiltInScene chain();
BuiltInScene stiff_spot();
BuiltInScene beam();
BuiltInScene spinning_bar();
BuiltInScene inclusion();
BuiltInScene flag();
BuiltInScene cradle();
BuiltInScene drape();
BuiltInScene pile();

}  // namespace jetlag
