// SPDX-License-Identifier: MIT
#include "jetlag/base/pages.hpp"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace jetlag {

void* allocate_pages(std::size_t bytes) {
  if (bytes < huge_page) return ::operator new(bytes);
  void* pages = ::operator new(bytes, std::align_val_t(huge_page));
#if defined(__linux__)
  madvise(pages, bytes, MADV_HUGEPAGE);  // advice: the system may not follow it
#endif
  return pages;
}

void free_pages(void* pages, std::size_t bytes) noexcept {
  if (bytes < huge_page)
    ::operator delete(pages);
  else
    ::operator delete(pages, std::align_val_t(huge_page));
}

}  // namespace jetlag
