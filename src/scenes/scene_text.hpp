// SPDX-License-Identifier: MIT
#pragma once
// The text of a scene, from where it comes.

#include <string>

namespace jetlag {

/// What a file or a pipe holds; "-": standard input. A pipe is read to its end; a named one that nobody writes to is
/// refused, not waited for. allowed: what else a scene may be.
/// Throws SceneError: cannot be read (no such file, no rights, a folder, a device), longer than 10^9 characters.
std::string scene_text(const std::string& name, const std::string& allowed);

}  // namespace jetlag
