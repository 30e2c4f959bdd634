# The comments of a header are read word for word, and the build ends with a reason where a header or a symbol is not
# there.
# In: script, work.

set(include ${work}/include)
file(REMOVE_RECURSE ${work})
file(WRITE ${include}/room/leap.hpp [==[
// SPDX-License-Identifier: MIT
#pragma once
// On top; a list [0, 1) and ${none} \n of it.
//
//     x -> y      a figure

// Not on top any more.
#include <vector>

class Leap;

/// Of another.
struct Other {};

/// First;  x_1 = x_0 [m].
///
/// Last.
class Leap final : public Other {
  /// Inside.
  int leap_;
};
/// A function.
std::vector<double> leaps(const Other& other);
]==])
file(WRITE ${include}/room/bare.hpp "#pragma once\n\nstruct Bare {};\n")

# Runs the script with a register of two files: one pair, twice, and none.
file(WRITE ${work}/none.cpp "{.declared = {}}\n")
function(read_docs header symbol outcome_name message_name)
  file(WRITE ${work}/register.cpp "{.declared = {{\"${header}\",\n  \"${symbol}\"}, {\"${header}\", \"${symbol}\"}}}\n")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D "register=${work}/none.cpp;${work}/register.cpp" -D include=${include} -D output=${work}/docs.cpp
            -D depfile=${work}/docs.d -P ${script}
    RESULT_VARIABLE outcome ERROR_VARIABLE message OUTPUT_VARIABLE ignored)
  string(REGEX REPLACE "[ \n]+" " " message "${message}")  # cmake breaks lines
  set(${outcome_name} ${outcome} PARENT_SCOPE)
  set(${message_name} "${message}" PARENT_SCOPE)
endfunction()

function(expect_docs symbol expected)
  read_docs(room/leap.hpp ${symbol} outcome message)
  if(NOT outcome EQUAL 0)
    message(FATAL_ERROR "${symbol} should be read, but:\n${message}")
  endif()
  file(READ ${work}/docs.cpp docs)
  string(FIND "${docs}" "${expected}" found)
  if(found EQUAL -1)
    message(FATAL_ERROR "${symbol}: expected\n${expected}\nin\n${docs}")
  endif()
endfunction()

set(top [==[R"doc(On top; a list [0, 1) and ${none} \n of it.

    x -> y      a figure
)doc"]==])
expect_docs(Leap "{\"room/leap.hpp\", \"Leap\",\n       ${top},\n       R\"doc(First;  x_1 = x_0 [m].\n\nLast.\n)doc\"}")
expect_docs(leaps "{\"room/leap.hpp\", \"leaps\",\n       ${top},\n       R\"doc(A function.\n)doc\"}")
file(READ ${work}/docs.d depends)
if(NOT depends STREQUAL "${work}/docs.cpp: ${include}/room/leap.hpp\n")
  message(FATAL_ERROR "The build should depend on the header, but: ${depends}")
endif()

function(expect_refusal header symbol reason)
  read_docs(${header} ${symbol} outcome message)
  string(FIND "${message}" "${reason}" found)
  if(outcome EQUAL 0 OR found EQUAL -1)
    message(FATAL_ERROR "${header}, ${symbol}: should be refused with \"${reason}\", but (${outcome}):\n${message}")
  endif()
endfunction()

expect_refusal(room/lost.hpp Leap "{\"room/lost.hpp\", \"Leap\"}: there is no header")
expect_refusal(room/leap.hpp Lost "{\"room/leap.hpp\", \"Lost\"}: the header declares no Lost")
expect_refusal(room/leap.hpp leap_ "declares no leap_")
expect_refusal(room/bare.hpp Bare "the header has no comment below #pragma once")
expect_refusal(ROOM/leap.hpp Leap "no {\"folder/header.hpp\", \"Symbol\"} in it")
