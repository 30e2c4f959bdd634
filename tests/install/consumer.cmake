# Installs the built library, then configures, builds and runs tests/consumer against that installation alone.
# In: jetlag_build, source, work, config, generator, make_program, compiler, flags, prefix_path.

function(step)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${work})  # a header that is no longer installed must not be found
step(${CMAKE_COMMAND} --install ${jetlag_build} --config ${config} --prefix ${work}/prefix)
# A user's own flags must not matter: once without any, once for whatever this machine has.
foreach(own_flags "" "-march=native")
  set(build ${work}/build${own_flags})
  step(${CMAKE_COMMAND} -S ${source} -B ${build} -G ${generator}
       -D CMAKE_MAKE_PROGRAM=${make_program} -D CMAKE_CXX_COMPILER=${compiler} -D CMAKE_BUILD_TYPE=${config}
       "-DCMAKE_CXX_FLAGS=${flags} ${own_flags}" "-DCMAKE_PREFIX_PATH=${work}/prefix;${prefix_path}")
  step(${CMAKE_COMMAND} --build ${build} --config ${config})
  step(${CMAKE_CTEST_COMMAND} --test-dir ${build} -C ${config} --output-on-failure --no-tests=error)
endforeach()
step(${work}/prefix/bin/jetlag --version)
