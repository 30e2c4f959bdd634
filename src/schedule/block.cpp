// SPDX-License-Identifier: MIT
#include "jetlag/schedule/block.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "jetlag/base/step_length.hpp"
#include "schedule/local/local_motion.hpp"

namespace jetlag {

/// All particles from a level on, ready to be expanded together; out of date once a particle crosses that level. Where
/// they are few, some go back and forth between two levels: the last of such choices are kept and found again.
struct BlockSteps::Group {
  static constexpr std::size_t few = 64, kept = 8;
  std::vector<std::unique_ptr<PartialExpansion>> choices;  // the last used first; of many particles only that
  bool is_current = false;

  PartialExpansion& expansion() { return *choices.front(); }

  static bool is_large(const PartialExpansion& choice) {
    return choice.active().size() + choice.known().size() > few;
  }

  void choose(const std::vector<int>& particles, LocalMotion& motion) {
    const auto found =
        std::ranges::find_if(choices, [&](const auto& former) { return former->active() == particles; });
    if (found != choices.end())
      std::rotate(choices.begin(), found, found + 1);
    else
      add(particles, motion);
    is_current = true;
  }

 private:
  void add(const std::vector<int>& particles, LocalMotion& motion) {
    std::unique_ptr<PartialExpansion> choice;
    if (!choices.empty() && (choices.size() == kept || is_large(expansion()))) {
      choice = std::move(choices.back());
      choices.pop_back();
    } else {
      choice = std::make_unique<PartialExpansion>(motion.group());
    }
    choice->choose(particles, motion.places());
    if (is_large(*choice)) choices.clear();
    choices.insert(choices.begin(), std::move(choice));
  }
};

BlockSteps::BlockSteps(const System<double>& system, TruncationLaw law, const Options& options)
    : ParticleClocks(system, std::move(law), options), grading_(options.grading) {
  if (grading_ < 0)
    throw std::invalid_argument("BlockSteps: grading must be at least 0, got " + std::to_string(grading_));
}
BlockSteps::~BlockSteps() = default;

void BlockSteps::begin_clocks() {
  const auto& moving = motion_->moving();
  level_.assign(motion_->model().particles(), 0);
  place_.assign(level_.size(), 0);
  of_level_.assign(Ticks::finest + 1, {});
  groups_.clear();
  groups_.resize(Ticks::finest + 1);
  for (int i : moving) {
    place_[i] = static_cast<int>(of_level_[0].size());
    of_level_[0].push_back(i);
  }
  begun_ = false;
  next_ = moving.empty() ? std::numeric_limits<std::int64_t>::max() : 0;
}

/// The first level from `level` on that has particles; beyond the finest where there is none.
int BlockSteps::lowest_from(int level) const {
  while (level <= Ticks::finest && of_level_[level].empty()) ++level;
  return level;
}

/// All particles from a level on, ascending.
const std::vector<int>& BlockSteps::due_from(int level) {
  if (groups_[level] && groups_[level]->is_current) return groups_[level]->expansion().active();
  const auto& moving = motion_->moving();
  std::size_t count = 0;
  for (int l = level; l <= Ticks::finest; ++l) count += of_level_[l].size();
  chosen_.clear();
  if (count > moving.size() / 32) {
    for (int i : moving)
      if (level_[i] >= level) chosen_.push_back(i);
  } else {
    for (int l = level; l <= Ticks::finest; ++l)
      chosen_.insert(chosen_.end(), of_level_[l].begin(), of_level_[l].end());
    std::ranges::sort(chosen_);
  }
  return chosen_;
}

BlockSteps::Group& BlockSteps::group_from(int level) {
  auto& group = groups_[level];
  if (!group) group = std::make_unique<Group>();
  if (!group->is_current) group->choose(due_from(level), *motion_);
  return *group;
}

bool BlockSteps::update(Report& report) {
  const Ticks::Count now = now_ = next_;
  const int level = lowest_from(Ticks::coarsest(now));
  const bool all = level == lowest_from(0);
  if (motion_->change_elements(now, all ? motion_->moving() : due_from(level)))
    for (auto& former : groups_) former.reset();
  Group* group = all ? nullptr : &group_from(level);
  motion_->remember(all ? std::span<const int>() : group->expansion().active());
  if (!(all ? motion_->update_all(now, report) : motion_->update(group->expansion(), now, report)))
    return false;
  updated_ = all ? &motion_->moving() : &group->expansion().active();
  if (!choose_levels(*updated_, now, report)) return false;
  wake_neighbours(now);
  begun_ = true;
  int finest = Ticks::finest;
  while (of_level_[finest].empty()) --finest;
  next_ = now + Ticks::step(finest);
  return true;
}

std::int64_t BlockSteps::step_of(int particle) const { return Ticks::step(level_[particle]); }

/// Levels for those that have been updated: what their series ask for, within the rules.
bool BlockSteps::choose_levels(const std::vector<int>& updated, std::int64_t now, Report& report) {
  const Ticks& ticks = motion_->ticks();
  const int coarsest = Ticks::coarsest(now);
  std::vector<int> stuck;
  before_.clear();
  for (int i : updated) {
    const int before = level_[i], level = motion_->level_of(i, std::max(begun_ ? before - 1 : 0, coarsest));
    before_.push_back(before);
    level_[i] = std::min(level, Ticks::finest);
    if (level > Ticks::finest || !advances(ticks.time(now), ticks.seconds(Ticks::step(level))))
      stuck.push_back(i);
  }
  if (!stuck.empty()) {
    report = underflow(now, stuck);
    return false;
  }
  // Who has been woken is due at the next multiple of its step.
  const auto step_of = [&](int i) {
    const Ticks::Count step = Ticks::step(level_[i]);
    return (now / step + 1) * step - motion_->begin_of(i);
  };
  motion_->up_to_kinks(now, updated, step_of, shortened_);
  if (motion_->sliding() >= 0) {
    report = sliding(now, motion_->sliding());
    return false;
  }
  if (motion_->elements().outcome != Outcome::success) {
    report = motion_->elements();
    return false;
  }
  for (const Kinks::Step& step : shortened_) {
    const int i = step.particle, level = std::min(ticks.level(step.h), Ticks::finest);
    if (level <= level_[i]) continue;
    if (motion_->begin_of(i) != now) {
      move(i, level_[i], level);
      motion_->count_wake_up();
    }
    level_[i] = level;
  }
  if (grading_ > 0) limit_differences(updated);
  for (std::size_t a = 0; a < updated.size(); ++a) move(updated[a], before_[a], level_[updated[a]]);
  return true;
}

/// Raises levels until no neighbour is more than `grading` finer: the same levels in whatever order particles come.
void BlockSteps::limit_differences(const std::vector<int>& updated) {
  raised_.clear();
  const Model<double>& model = motion_->model();
  const auto raise = [&model, this, level = level_.data(), grading = grading_](int i) {
    int least = level[i];
    for (int n : model.neighbours(i)) least = std::max(least, level[n] - grading);
    if (least == level[i]) return;
    level[i] = least;
    raised_.push_back(i);
  };
  for (int i : updated) raise(i);
  // Whoever was raised may ask the same of its neighbours, as far as they are updated now.
  for (std::size_t r = 0; r < raised_.size(); ++r)
    for (int n : model.neighbours(raised_[r]))
      if (motion_->begin_of(n) == now_) raise(n);
}

/// Those that rely on a series which has come to its end at a kink, or on one that has changed with it: woken at the
/// coarsest tick up to which it does not depart from what they were told.
void BlockSteps::wake_neighbours(std::int64_t now) {
  woken_.clear();
  for (std::size_t k = 0; k < motion_->former().size(); ++k) {
    const int i = motion_->former()[k];
    for (int n : motion_->model().neighbours(i)) {
      if (motion_->begin_of(n) == now) continue;
      const auto due = [&](int level) { return (now / Ticks::step(level) + 1) * Ticks::step(level); };
      int level = level_[n];
      while (level < level_[i] && !motion_->keeps_its_word(k, due(level))) ++level;
      if (level > level_[n]) woken_.push_back({n, level});
    }
  }
  for (const auto& [n, level] : woken_) {
    if (level <= level_[n]) continue;
    motion_->doubt(n);
    move(n, level_[n], level);
    level_[n] = level;
    motion_->count_wake_up();
  }
}

void BlockSteps::move(int particle, int from, int to) {
  if (from == to) return;
  auto& old = of_level_[from];
  old[place_[particle]] = old.back();
  place_[old.back()] = place_[particle];
  old.pop_back();
  place_[particle] = static_cast<int>(of_level_[to].size());
  of_level_[to].push_back(particle);
  for (int l = std::min(from, to) + 1; l <= std::max(from, to); ++l)
    if (groups_[l]) groups_[l]->is_current = false;
}

}  // namespace jetlag
