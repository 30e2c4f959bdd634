// SPDX-License-Identifier: MIT
#include "jetlag/motion/trajectory.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "jetlag/base/text.hpp"

namespace jetlag {

namespace {

[[noreturn]] void refuse(const std::string& why) { throw std::invalid_argument("Trajectory: " + why); }

std::string shape(int particles, int dimension) {
  return "(" + std::to_string(particles) + ", " + std::to_string(dimension) + ")";
}

/// The number of the last of `count` ascending times that is not after t; the first one is not.
template <class Time>
std::size_t last_not_after(double t, std::size_t count, const Time& time) {
  std::size_t low = 0;
  while (count > 1) {
    const std::size_t half = count / 2;
    low += time(low + half) <= t ? half : 0;
    count -= half;
  }
  return low;
}

/// The row of one particle.
Trajectory::Row row_of(const CoefficientsView& c, int particle, double s) {
  if (particle < 0 || particle >= c.particles())
    refuse("particle " + std::to_string(particle) + " does not exist, there are " +
           std::to_string(c.particles()));
  Trajectory::Row row(c.dimension());
  c.sum_of(particle, s, row.data());
  return row;
}

}  // namespace

struct Trajectory::Place {
  double begin, unit;  // [s]
  std::uint32_t offset;
  std::uint32_t positions, velocities;  // how many coefficients
};

namespace {
constexpr std::size_t place_size = 4;  // numbers
}

/// Where the place of a piece of a block stands in its numbers.
std::size_t Trajectory::at_back(const Block& block, std::size_t piece) {
  return block.numbers.size() - place_size * (piece + 1);
}

void Trajectory::add(const PieceView& piece) {
  const CoefficientsView &x = piece.position, &v = piece.velocity;
  if (x.empty() || v.empty()) refuse("a piece without coefficients");
  if (!(piece.begin <= piece.end))
    refuse("a piece from " + number(piece.begin) + " to " + number(piece.end) + " ends before it begins");
  if (x.dimension() > 3) refuse("a piece of " + std::to_string(x.dimension()) + " components, at most 3");
  if (empty()) {
    particles_ = x.particles();
    dimension_ = x.dimension();
  } else if (piece.begin != end()) {
    refuse("a piece begins at " + number(piece.begin) + ", the last one ends at " + number(end()));
  }
  for (const CoefficientsView& c : {x, v})
    if (c.particles() != particles_ || c.dimension() != dimension_)
      refuse("a piece of shape " + shape(c.particles(), c.dimension()) + ", not " +
             shape(particles_, dimension_));
  Block& block = block_for(x.numbers() + v.numbers(), piece.begin);
  const Place place{piece.begin, piece.unit, static_cast<std::uint32_t>(block.used),
                    static_cast<std::uint32_t>(x.size()), static_cast<std::uint32_t>(v.size())};
  static_assert(sizeof place == place_size * sizeof(double));
  double* numbers = block.numbers.data();
  x.copy_to(numbers + block.used);
  v.copy_to(numbers + block.used + x.numbers());
  std::memcpy(numbers + at_back(block, block.pieces), &place, sizeof place);
  block.used += x.numbers() + v.numbers();
  ++block.pieces;
  ++size_;
  end_ = piece.end;
}

/// The last block, or a new one where a piece of so many numbers has no room in it: none is ever enlarged.
Trajectory::Block& Trajectory::block_for(std::size_t numbers, double begin) {
  numbers += place_size;
  if (blocks_.empty() ||
      blocks_.back().numbers.size() - blocks_.back().used < numbers + place_size * blocks_.back().pieces) {
    constexpr std::size_t page = 4096, most_in_small = 2 * huge_page;
    const std::size_t so_far = bytes(),
                      bytes = so_far < most_in_small ? std::max(page, so_far / 8) : huge_page;
    const std::size_t pieces =
        (bytes / sizeof(double) + numbers - 1) / numbers;  // no rest, where all are alike
    blocks_.push_back({PageVector(numbers * pieces), size_, begin});
  }
  return blocks_.back();
}

PieceView Trajectory::piece_in(std::size_t block, std::size_t piece) const {
  const Block& in = blocks_[block];
  const double* numbers = in.numbers.data();
  Place place;
  std::memcpy(&place, numbers + at_back(in, piece), sizeof place);
  const double end = piece + 1 < in.pieces        ? numbers[at_back(in, piece + 1)]
                     : block + 1 < blocks_.size() ? blocks_[block + 1].begin
                                                  : end_;
  const auto series = [&](const double* first, std::size_t count) {
    return CoefficientsView(first, count, particles_, dimension_, dimension_);
  };
  const CoefficientsView position = series(numbers + place.offset, place.positions);
  return {place.begin, end, position, series(numbers + place.offset + position.numbers(), place.velocities),
          place.unit};
}

PieceView Trajectory::piece(std::size_t p) const {
  const auto next = std::ranges::upper_bound(blocks_, p, {}, &Block::first);
  const auto block = static_cast<std::size_t>(next - blocks_.begin()) - 1;
  return piece_in(block, p - blocks_[block].first);
}

double Trajectory::begin() const {
  if (empty()) refuse("there is no piece yet");
  return blocks_.front().begin;
}

double Trajectory::end() const {
  if (empty()) refuse("there is no piece yet");
  return end_;
}

PieceView Trajectory::piece_at(double t) const {
  if (!(begin() <= t && t <= end()))
    refuse("t = " + number(t) + " lies outside of [" + number(begin()) + ", " + number(end()) + "]");
  const std::size_t block =
      last_not_after(t, blocks_.size(), [&](std::size_t b) { return blocks_[b].begin; });
  const Block& in = blocks_[block];
  const double* begins = in.numbers.data() + at_back(in, 0);
  return piece_in(block,
                  last_not_after(t, in.pieces, [=](std::size_t p) { return *(begins - place_size * p); }));
}

Trajectory::Row Trajectory::position(int particle, double t) const {
  const PieceView piece = piece_at(t);
  return row_of(piece.position, particle, (t - piece.begin) / piece.unit);
}

Trajectory::Row Trajectory::velocity(int particle, double t) const {
  const PieceView piece = piece_at(t);
  return row_of(piece.velocity, particle, (t - piece.begin) / piece.unit);
}

std::size_t Trajectory::bytes() const {
  std::size_t total = blocks_.capacity() * sizeof(Block);
  for (const Block& block : blocks_) total += block.numbers.capacity() * sizeof(double);
  return total;
}

}  // namespace jetlag
