// SPDX-License-Identifier: MIT
// Every method that a scene can name has a page, and what the page says is so.
#include "scenes/methods/methods.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "jetlag/scenes/error.hpp"
#include "scenes/parts.hpp"
#include "support/problems.hpp"
#include "support/program.hpp"

namespace jetlag {
void PrintTo(const MethodRecord& page, std::ostream* out) { *out << page.name; }
}  // namespace jetlag

namespace jetlag::testing::methods_test {
namespace {

using jetlag::Json;  // with keys in their order
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::filesystem::path source = JETLAG_SOURCE_DIR;

/// Those of `names` that are not in `others`.
std::vector<std::string> missing(const std::vector<std::string>& names,
                                 const std::vector<std::string>& others) {
  std::vector<std::string> found;
  for (const std::string& name : names)
    if (std::ranges::find(others, name) == others.end()) found.push_back(name);
  return found;
}

TEST(Methods, HaveAPageEachAndNothingElseHas) {
  std::vector<std::string> clocks = schedule_types();
  ASSERT_EQ(std::erase(clocks, "lockstep"), 1u);
  std::size_t types = 0;
  for (const auto& [named_by, names] :
       {std::pair<std::string, std::vector<std::string>>{"integrator.type", integrator_types()},
        {"schedule.type", clocks}}) {
    std::vector<std::string> pages;
    for (const MethodRecord& page : method_records())
      if (page.named_by == named_by) pages.push_back(page.name);
    for (const std::string& name : missing(names, pages))
      ADD_FAILURE() << named_by << " \"" << name
                    << "\" has no page: add its entry to a list in src/scenes/methods";
    for (const std::string& name : missing(pages, names))
      ADD_FAILURE() << "the page of \"" << name << "\" in src/scenes/methods is of no " << named_by;
    types += names.size();
  }
  EXPECT_EQ(method_records().size(), types) << "a method has two pages in src/scenes/methods";
}

class MethodPages : public ::testing::TestWithParam<MethodRecord> {};
INSTANTIATE_TEST_SUITE_P(, MethodPages, ::testing::ValuesIn(method_records()),
                         [](const auto& info) { return info.param.name; });

// ---- sections ----------------------------------------------------------------------------------------------

TEST_P(MethodPages, HaveEverySectionAndEachHoldsSomething) {
  const std::string page = markdown(GetParam());
  EXPECT_THAT(page, StartsWith("# " + GetParam().name + "\n\n" + GetParam().what + ".\n"));
  std::size_t at = 0;
  for (const char* title : {"Equations", "When to use it", "In a scene", "What proves it", "Source"}) {
    const std::string heading = "\n## " + std::string(title) + "\n\n";
    at = page.find(heading, at);
    ASSERT_NE(at, std::string::npos) << title;
    at += heading.size();
    // A paragraph, a table or a list; not the next heading, and of Source not what stands below all of them.
    const std::string first = page.substr(at, page.find('\n', at) - at);
    EXPECT_GT(first.size(), 8u) << title;
    EXPECT_NE(first.front(), '#') << title;
    EXPECT_FALSE(first.starts_with("What stands")) << title;
  }
  EXPECT_FALSE(GetParam().what.empty() || GetParam().what.ends_with('.'));
  EXPECT_FALSE(GetParam().keys.empty() || GetParam().examples.empty() || GetParam().proofs.empty());
}

TEST_P(MethodPages, ShowWhatTheHeaderSaysWordForWord) {
  // Each line of a code block of the section of equations stands in its header, behind the slashes.
  const std::string page = markdown(GetParam());
  std::istringstream lines(page.substr(0, page.find("\n## When to use it\n")));
  std::string header, line;
  int blocks = 0, shown = 0;
  bool inside = false;
  while (std::getline(lines, line)) {
    if (line.starts_with("From `")) {
      const std::filesystem::path file = source / line.substr(6, line.find('`', 6) - 6);
      header = content(file);
      EXPECT_FALSE(header.empty()) << file;
    } else if (line.starts_with("```")) {
      inside = !inside;
      blocks += inside;
    } else if (inside && !line.empty()) {
      ++shown;
      EXPECT_TRUE(header.find("\n// " + line + "\n") != std::string::npos ||
                  header.find("\n/// " + line + "\n") != std::string::npos)
          << line;
    }
  }
  EXPECT_EQ(blocks, static_cast<int>(GetParam().declared.size()));
  EXPECT_GT(shown, 2);
}

TEST(Methods, AreDescribedByTheWholeCommentOnTopAndTheWholeDocstring) {
  // Two headers, counted by hand: top and docstring, with and without empty lines between.
  const auto text = [](const std::string& header, const std::string& symbol) {
    const auto found = std::ranges::find_if(
        header_texts(), [&](const HeaderText& one) { return one.header == header && one.symbol == symbol; });
    EXPECT_NE(found, header_texts().end()) << header;
    return *found;
  };
  const HeaderText leapfrog = text("integrators/explicit/leapfrog.hpp", "Leapfrog");
  EXPECT_EQ(
      leapfrog.top,
      "Leapfrog in its velocity form (Stoermer, Verlet; not the midpoint leapfrog of fluid dynamics).\n");
  EXPECT_THAT(leapfrog.docstring,
              StartsWith("x_1 = x_0 + h v_0 + h^2/2 a_0,   v_1 = v_0 + h/2 (a_0 + a_1).\n"));
  EXPECT_TRUE(leapfrog.docstring.ends_with("Source: [HLW06] I.1.4.\n")) << leapfrog.docstring;
  const HeaderText avi = text("schedule/avi.hpp", "Avi");
  EXPECT_THAT(avi.top, HasSubstr("\n\n    element 0   |-------|"));
  EXPECT_TRUE(avi.top.ends_with(
      "\nOther ratios of steps have narrower bands. `without_resonance` keeps out of them.\n"));
  EXPECT_EQ(avi.docstring, "");
}

TEST_P(MethodPages, NameSourcesThatAreListed) {
  const auto sources = sources_of(GetParam().declared);
  EXPECT_FALSE(sources.empty());
  const std::string list = content(source / "include/jetlag/sources.md");
  for (const std::string& text : sources)
    for (auto open = text.find('['); open != std::string::npos; open = text.find('[', open + 1)) {
      const std::string tag = text.substr(open, text.find(']', open) + 1 - open);
      EXPECT_THAT(list, HasSubstr(tag)) << text;
    }
}

// ---- keys and examples -------------------------------------------------------------------------------------

/// Reads the parts of a scene for eight particles with springs. Throws SceneError.
Method read(Json& scene) {
  Value(scene, "").only({"integrator", "control", "schedule"});  // room for all
  const Problem cube = spring_cube(1);
  return read_method(Value(scene, ""), std::make_shared<const System<double>>(cube.system), cube.start, 1);
}

/// What is said of a scene with another value of a key ("part.key"); nothing to take it out.
std::string refusal(const std::string& example, const std::string& key, const std::optional<Json>& value) {
  Json scene = Json::parse(example);
  const std::string part = key.substr(0, key.find('.')), name = key.substr(key.find('.') + 1);
  if (value)
    scene[part][name] = *value;
  else
    scene[part].erase(name);
  try {
    read(scene);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

/// Whether the reader looks at a key: it refuses an object there, by the name of the key and not as unknown.
bool is_read(const std::string& example, const std::string& key) {
  const std::string said = refusal(example, key, Json::object());
  return said.starts_with(key) && said.find("unknown key") == std::string::npos;
}

/// Where "part.key" stands in a scene.
Json::json_pointer pointer(std::string key) {
  return Json::json_pointer("/" + key.replace(key.find('.'), 1, "/"));
}

bool has(const std::string& example, const std::string& key) {
  return Json::parse(example).contains(pointer(key));
}

TEST_P(MethodPages, HaveExamplesThatRun) {
  for (const std::string& example : GetParam().examples) {
    Json scene = Json::parse(example);
    const Method method = read(scene);
    EXPECT_EQ(scene.at(pointer(GetParam().named_by)), GetParam().name);
    State<double> state = spring_cube(1).start;
    EXPECT_EQ(method.schedule()->run(state, 0.25, {}).outcome, Outcome::success) << example;
    EXPECT_EQ(state.time, 0.25);
  }
}

TEST_P(MethodPages, ListKeysThatAreReadWithTheirDefaults) {
  const MethodRecord& page = GetParam();
  std::set<std::string> listed;
  for (const SceneKey& key : page.keys) {
    EXPECT_TRUE(listed.insert(key.key).second) << key.key << " is listed twice";
    EXPECT_TRUE(std::ranges::any_of(page.examples, [&](const auto& e) { return is_read(e, key.key); }))
        << key.key << " is read in no example";
    if (key.fallback.starts_with("none")) continue;
    bool seen = false;
    for (const std::string& example : page.examples) {
      if (key.fallback.starts_with("required")) {
        if (!has(example, key.key)) continue;
        seen = true;
        EXPECT_NE(refusal(example, key.key, std::nullopt), "")
            << key.key << " is not required in " << example;
      } else if (!has(example, key.key)) {
        Json scene = Json::parse(example);
        read(scene);  // puts in what is left out
        if (!scene.contains(pointer(key.key))) continue;
        seen = true;
        const Json value = scene.at(pointer(key.key));
        const Json number = Json::parse(key.fallback, nullptr, false);
        EXPECT_EQ(value, number.is_discarded() ? Json(key.fallback) : number) << key.key;
      }
    }
    EXPECT_TRUE(seen) << key.key << ": no example shows that it is " << key.fallback;
  }
}

TEST_P(MethodPages, ListEveryKeyThatIsRead) {
  // An unknown key is refused with those that are allowed there. A clock schedule takes the keys of its integrator too,
  // which are on the page of that.
  const MethodRecord& page = GetParam();
  std::set<std::string> listed = {page.named_by};
  for (const SceneKey& key : page.keys) listed.insert(key.key);
  for (const std::string& example : page.examples)
    for (const std::string part : {"integrator", "control", "schedule"}) {
      if (page.named_by == "schedule.type" && (part == "integrator" || !has(example, part + ".type")))
        continue;
      const std::string said = refusal(example, part + ".no_such_key", 1), allowed = "allowed here: ";
      const auto begin = said.find(allowed);
      ASSERT_NE(begin, std::string::npos) << part << ": " << said;
      std::istringstream words(said.substr(begin + allowed.size()));
      for (std::string word; words >> word;) {
        if (word == "or") continue;
        const std::string key = part + "." + word.substr(0, word.find(','));
        if (is_read(example, key)) {
          EXPECT_TRUE(listed.contains(key)) << key << " is read, and is not on the page of " << page.name;
        }
      }
    }
}

// ---- proofs ------------------------------------------------------------------------------------------------

TEST_P(MethodPages, AreProvedByTestsThatHoldTheirNumbers) {
  for (const Proof& proof : GetParam().proofs) {
    const std::filesystem::path file = source / "tests" / proof.file;
    ASSERT_TRUE(std::filesystem::exists(file)) << file;
    const std::string tests = content(file);
    const auto dot = proof.test.find('.');
    const std::string name = "(" + proof.test.substr(0, dot) + ", " + proof.test.substr(dot + 1) + ") {";
    const auto begin = tests.find(name);
    ASSERT_NE(begin, std::string::npos) << proof.test << " is not in " << file;
    const std::string body = tests.substr(begin, tests.find("\n}\n", begin) - begin);
    EXPECT_THAT(body, HasSubstr(proof.number)) << proof.test;
  }
}

}  // namespace
}  // namespace jetlag::testing::methods_test
