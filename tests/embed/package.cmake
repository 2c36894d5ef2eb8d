# The library as others receive it: installed, static and shared, moved to another folder, then found
# by find_package and by pkg-config from C projects outside the tree. Uses of add_subdirectory and of
# the single header are tested by symbols.cmake and by the tests that compile it. What is built here
# by COMPILER, as it ships, other tests look at: the static one as any Release build would make it, the
# shared one with fused multiply-add allowed. Both are compiled in batches of eight files, for speed.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/golden/fused.cmake)
find_program(cc NAMES cc gcc clang REQUIRED)
find_program(nm nm REQUIRED)
find_program(pkg_config NAMES pkg-config pkgconf)

function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# Every function that the header declares, and nothing else, leaves a shared library.
function(check_exports library)
  file(STRINGS ${ROOT}/src/wireskin.h lines REGEX "^WSK_API ")
  list(TRANSFORM lines REPLACE "^WSK_API .*(wsk_[a-z_0-9]+)\\(.*$" "\\1" OUTPUT_VARIABLE declared)
  execute_process(COMMAND ${nm} -D --defined-only ${library} OUTPUT_VARIABLE text
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL " [TDBRVWi] [^\n]+" exported "${text}")
  list(TRANSFORM exported REPLACE "^ . " "")
  list(SORT declared)
  list(SORT exported)
  list(LENGTH declared count)
  if(count LESS 8 OR NOT declared STREQUAL exported)
    message(SEND_ERROR "the header declares ${declared}, the shared library exports ${exported}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
foreach(shared OFF ON)
  set(work ${WORK}/shared_${shared})
  set(flags "-O3")
  if(shared)
    set(flags "-O2 ${fused}")
  endif()
  run(${CMAKE_COMMAND} -S ${ROOT} -B ${work}/build -DCMAKE_BUILD_TYPE=Release
      -DCMAKE_CXX_COMPILER=${COMPILER} "-DCMAKE_CXX_FLAGS_RELEASE=${flags} -DNDEBUG"
      -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 -DBUILD_SHARED_LIBS=${shared}
      -DWIRESKIN_BUILD_TESTS=OFF -DWIRESKIN_BUILD_EXAMPLES=OFF -DCMAKE_INSTALL_PREFIX=${work}/first)
  run(${CMAKE_COMMAND} --build ${work}/build -j 2)
  run(${CMAKE_COMMAND} --install ${work}/build)
  file(RENAME ${work}/first ${work}/moved)

  run(${CMAKE_COMMAND} -S ${ROOT}/tests/embed/consumer -B ${work}/consumer
      -DCMAKE_PREFIX_PATH=${work}/moved)
  run(${CMAKE_COMMAND} --build ${work}/consumer)
  run(${work}/consumer/consumer)

  file(GLOB_RECURSE pc ${work}/moved/wireskin.pc)
  get_filename_component(pc_dir ${pc} DIRECTORY)
  get_filename_component(lib_dir ${pc_dir} DIRECTORY)
  if(shared)
    file(GLOB library ${lib_dir}/libwireskin.so)
    if(library)
      check_exports(${library})
    endif()
  endif()
  if(NOT pkg_config)
    message(STATUS "pkg-config is not here: not tested")
    continue()
  endif()
  set(ENV{PKG_CONFIG_PATH} ${pc_dir})
  set(how --cflags --libs)
  if(NOT shared)
    list(APPEND how --static)
  endif()
  execute_process(COMMAND ${pkg_config} ${how} wireskin OUTPUT_VARIABLE flags
                  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(${cc} -std=c89 -pedantic-errors ${ROOT}/tests/embed/c89_user.c ${flags} -o ${work}/by_pkg_config)
  run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${lib_dir} ${work}/by_pkg_config)
endforeach()
