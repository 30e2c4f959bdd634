# What all targets of this repository share, and what nobody who links the library inherits.
function(jetlag_own_target target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  # a * b + c is rounded twice unless the code asks for a fused multiply-add by name.
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wnon-virtual-dtor
                                           -Woverloaded-virtual -Wextra-semi -Wundef)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ 12 merges functions of jets of different degrees (-fipa-icf) and then warns of the larger one's bounds.
    target_compile_options(${target} PRIVATE -Wno-array-bounds)
    # g++ 12 warns of "literal" + std::string: PR 105651, PR 105329
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
    if(CMAKE_CXX_FLAGS MATCHES "-fsanitize")
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)  # instrumented code misleads it
    endif()
  endif()
  # TBB has it of those who link it in Debug; a precompiled header that targets share wants the same of all of them.
  target_compile_definitions(${target} PRIVATE $<$<CONFIG:Debug>:TBB_USE_DEBUG>)
  if(JETLAG_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# For what no time of a run depends on: it is optimised little, for that takes a quarter off the time of compiling it.
function(jetlag_runs_once target)
  if(CMAKE_CXX_FLAGS_RELEASE MATCHES "-O[23]")
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()
