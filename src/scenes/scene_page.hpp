// SPDX-License-Identifier: MIT
#pragma once
// What a scene file may hold and what a run of it leaves, as a page.

#include <string>

namespace jetlag {

/// In Markdown. Tables are made of the records by which scenes are checked; methods have pages of their own.
std::string scene_page();

}  // namespace jetlag
