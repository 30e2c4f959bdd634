// SPDX-License-Identifier: MIT
#pragma once
// The colours of the pictures, in one place.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace jetlag {

struct Colour {
  double red = 0, green = 0, blue = 0;  // 0 to 255

  /// 0xRRGGBB.
  unsigned code() const {
    const auto byte = [](double part) {
      return static_cast<unsigned>(std::lround(std::clamp(part, 0.0, 255.0)));
    };
    return byte(red) << 16 | byte(green) << 8 | byte(blue);
  }
};

constexpr Colour colour(unsigned code) {
  return {double(code >> 16 & 255), double(code >> 8 & 255), double(code & 255)};
}

/// From a (share 0) to b (share 1).
constexpr Colour mixed(const Colour& a, const Colour& b, double share) {
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
          a.blue + share * (b.blue - a.blue)};
}

constexpr Colour white = colour(0xffffff), ink = colour(0x2b2f36), pencil = colour(0x8a9099);

/// Colours for values from 0 to 1.
struct Palette {
  std::vector<Colour> stops;  // evenly spaced, at least two

  Colour operator()(double value) const {
    const double last = static_cast<double>(stops.size() - 1);
    const double place = std::clamp(value, 0.0, 1.0) * last;
    const double stop = std::min(std::floor(place), last - 1.0);
    const auto i = static_cast<std::size_t>(stop);
    return mixed(stops[i], stops[i + 1], place - stop);
  }
};

/// Rest is cool and light, haste is warm.
inline Palette speed_palette() {
  return {{colour(0xa9cbea), colour(0xe3e6d0), colour(0xffd778), colour(0xf78f45), colour(0xd53e37)}};
}

/// Blue is compressed (0), grey at rest (1/2), red is stretched (1).
inline Palette strain_palette() {
  return {{colour(0x1f5fb4), colour(0x6a9bd1), colour(0xb4b9c0), colour(0xe0806a), colour(0xc0302b)}};
}

/// A few bodies, told apart by colour: Paul Tol's "bright", safe for colour-blind eyes.
inline Colour body_colour(std::size_t body) {
  constexpr std::array<unsigned, 6> codes = {0x4477aa, 0xee6677, 0x228833, 0xccbb44, 0x66ccee, 0xaa3377};
  return colour(codes[body % codes.size()]);
}

}  // namespace jetlag
