# What the headers say of the methods, as C++: for each {"folder/header.hpp", "Symbol"} in a record the comment on top
# of the header and the docstring (///) above the declaration of the symbol, word for word.
# In: register (the files that list the pages), include (the folder that holds the headers), output (written); depfile (optional).

cmake_minimum_required(VERSION 3.25)

# The comment on top of `content`: what stands after #pragma once, without its slashes.
# The docstring of `symbol`: the lines of /// directly above its declaration, which begins at the margin.
function(read_comments content symbol top_name docstring_name found_name)
  set(declaration "^[A-Za-z_][A-Za-z0-9_:<>&*, ]* ${symbol}([ ({]|$)")
  set(place before)
  set(found FALSE)
  foreach(name top block docstring)
    set(${name} "")
  endforeach()
  while(NOT content STREQUAL "")
    string(FIND "${content}" "\n" end)
    if(end EQUAL -1)
      string(APPEND content "\n")
      continue()
    endif()
    string(SUBSTRING "${content}" 0 ${end} line)
    math(EXPR end "${end} + 1")
    string(SUBSTRING "${content}" ${end} -1 content)
    if(line STREQUAL "#pragma once")
      set(place top)
    elseif(place STREQUAL "top" AND line MATCHES "^//([^/]|$)")
      string(REGEX REPLACE "^// ?" "" line "${line}")
      string(APPEND top "${line}\n")
    elseif(line STREQUAL "" AND NOT top STREQUAL "")
      set(place below)
      set(block "")
    elseif(line MATCHES "^///")
      string(REGEX REPLACE "^/// ?" "" line "${line}")
      string(APPEND block "${line}\n")
    elseif(line MATCHES "${declaration}")
      set(found TRUE)
      set(docstring "${block}")
      break()
    else()
      set(block "")
    endif()
  endwhile()
  set(${top_name} "${top}" PARENT_SCOPE)
  set(${docstring_name} "${docstring}" PARENT_SCOPE)
  set(${found_name} ${found} PARENT_SCOPE)
endfunction()

set(generated "// Made by .cmake/method_docs.cmake from the headers that the register of pages names.
#include \"scenes/methods/methods.hpp\"

namespace jetlag {

const std::vector<HeaderText>& header_texts() {
  static const std::vector<HeaderText> texts = {
")
set(headers "")
set(seen "")
foreach(file IN LISTS register)
  file(READ "${file}" entries)
  string(REGEX MATCHALL "{\"[a-z_]+/[a-z0-9_/]+\\.hpp\",[ \n]*\"[A-Za-z0-9_]+\"}" pairs "${entries}")
  foreach(pair IN LISTS pairs)
    string(REGEX MATCH "\"([^\"]+)\",[ \n]*\"([^\"]+)\"" pair "${pair}")
    set(header "${CMAKE_MATCH_1}")
    set(symbol "${CMAKE_MATCH_2}")
    if("${header} ${symbol}" IN_LIST seen)
      continue()
    endif()
    list(APPEND seen "${header} ${symbol}")
    set(place "${file}: {\"${header}\", \"${symbol}\"}")
    if(NOT EXISTS "${include}/${header}")
      message(FATAL_ERROR "${place}: there is no header ${include}/${header}")
    endif()
    file(READ "${include}/${header}" content)
    read_comments("${content}" ${symbol} top docstring found)
    if(NOT found)
      message(FATAL_ERROR "${place}: the header declares no ${symbol} at its margin")
    endif()
    if(top STREQUAL "")
      message(FATAL_ERROR "${place}: the header has no comment below #pragma once")
    endif()
    string(APPEND generated
           "      {\"${header}\", \"${symbol}\",\n       R\"doc(${top})doc\",\n       R\"doc(${docstring})doc\"},\n")
    string(APPEND headers " ${include}/${header}")
  endforeach()
endforeach()
if(NOT seen)
  message(FATAL_ERROR "${register}: no {\"folder/header.hpp\", \"Symbol\"} in it")
endif()
string(APPEND generated "  };
  return texts;
}

}  // namespace jetlag
")
file(WRITE "${output}" "${generated}")
if(depfile)
  file(WRITE "${depfile}" "${output}:${headers}\n")
endif()
