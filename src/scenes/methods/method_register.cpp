// SPDX-License-Identifier: MIT
#include "scenes/methods/method_register.hpp"

namespace jetlag {

const std::vector<MethodPage>& method_pages() {
  static const std::vector<MethodPage> pages = [] {
    std::vector<MethodPage> all;
    for (const auto& family : {taylor_pages(), one_step_pages(), clock_pages()})
      all.insert(all.end(), family.begin(), family.end());
    return all;
  }();
  return pages;
}

}  // namespace jetlag
