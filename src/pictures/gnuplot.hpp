// SPDX-License-Identifier: MIT
#pragma once
// gnuplot as a child process, in a folder of its own, without a shell between.

#include <filesystem>
#include <string>
#include <string_view>

namespace jetlag::gnuplot {

/// The program, from the folders of PATH; empty when it is not there.
std::filesystem::path program();

/// Text in the language of gnuplot: nothing in it is expanded. Control characters become spaces.
std::string quoted(std::string_view text);

/// Size of a picture and of its letters, in pixels.
struct Sheet {
  double width, height;
  double letters = 16;
};

/// Runs the commands on a sheet and puts the result in the place of `picture`. The commands may read `data`
/// under the name data.csv; no other name of a file appears in them.
void draw(const std::filesystem::path& picture, const Sheet& sheet, const std::string& commands,
          const std::string& data = {});

}  // namespace jetlag::gnuplot
