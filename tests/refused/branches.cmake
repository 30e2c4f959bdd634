# A law that branches on a recorded value does not compile, and the message says what to do. The same laws do compile
# for numbers and jets, and the one with select for all.
# In: compiler, flags, includes, source.

separate_arguments(flags UNIX_COMMAND "${flags}")
list(TRANSFORM includes PREPEND -I)

function(record law outcome_name message_name)
  execute_process(
    COMMAND ${compiler} ${flags} -std=c++20 -DEIGEN_MAX_ALIGN_BYTES=64 ${includes} -DRECORDED=${law}
            -fsyntax-only ${source}
    RESULT_VARIABLE outcome ERROR_VARIABLE message OUTPUT_VARIABLE message)
  set(${outcome_name} ${outcome} PARENT_SCOPE)
  set(${message_name} "${message}" PARENT_SCOPE)
endfunction()

record(by_select outcome message)
if(NOT outcome EQUAL 0)
  message(FATAL_ERROR "A law with select should compile, but:\n${message}")
endif()

foreach(law by_if by_while by_conditional by_and_with_bool)
  record(${law} outcome message)
  string(FIND "${message}" "a recorded law has no branches: use jetlag::select(condition, a, b)" found)
  if(outcome EQUAL 0 OR found EQUAL -1)
    message(FATAL_ERROR "${law} should be refused with the reason, but (${outcome}):\n${message}")
  endif()
endforeach()
