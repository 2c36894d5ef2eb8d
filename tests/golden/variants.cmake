# The golden hashes come out the same from every compiler at hand, unoptimised and optimised, with and
# without fused multiply-add, from separate sources and from the single header (which gets no flag that
# keeps floating point strict: it must do so itself, so it is the one that each compiler may fuse).
# TIER=quick builds one of the variants; TIER=full the others: each compiler has each of the three both
# ways, not all eight together. PACKAGE is the folder of embed/package, which has the variants of
# separate sources that COMPILER makes. Sources are separate in batches of eight, for speed; the
# sanitized build compiles each by itself, golden tests among its own.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
include(${ROOT}/tests/embed/find_compilers.cmake)
include(${ROOT}/tests/golden/fused.cmake)

file(GLOB_RECURSE sources ${ROOT}/src/*.cpp)
set(batches "")
set(text "")
foreach(source IN LISTS sources)
  string(APPEND text "#include \"${source}\"\n")
  string(REGEX MATCHALL "\n" lines "${text}")
  list(LENGTH lines count)
  if(count EQUAL 8)
    list(LENGTH batches number)
    list(APPEND batches ${WORK}/batch_${number}.cpp)
    file(WRITE ${WORK}/batch_${number}.cpp "${text}")
    set(text "")
  endif()
endforeach()
file(WRITE ${WORK}/batch_last.cpp "${text}")
list(APPEND batches ${WORK}/batch_last.cpp)

function(run cxx what print)
  execute_process(COMMAND ${print} --arrays OUTPUT_VARIABLE text RESULT_VARIABLE result)
  get_filename_component(name ${cxx} NAME)
  if(result EQUAL 0)
    message(STATUS "${name} ${what}: equal")
  else()
    message(SEND_ERROR "${name} ${what}: other bits than tests/golden/golden.h\n${text}")
  endif()
endfunction()

# The scenes are input: their arithmetic must not be contracted. They are compiled once by each
# compiler, whatever the library's flags.
function(compile_scenes cxx)
  file(MAKE_DIRECTORY ${WORK}/scenes)
  execute_process(COMMAND ${cxx} -std=c++17 -O1 -ffp-contract=off -I${ROOT}/tests -I${WORK}
                          -c ${golden_sources}
                  WORKING_DIRECTORY ${WORK}/scenes COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(check_variant cxx form flags)
  separate_arguments(flag_list UNIX_COMMAND "${flags}")
  file(GLOB scenes ${WORK}/scenes/*.o)
  if(form STREQUAL "single")
    set(library -I${WORK} ${implementation})
  else()
    set(library -I${ROOT}/src -ffp-contract=off ${batches})
  endif()
  execute_process(COMMAND ${cxx} -std=c++17 ${flag_list} ${library} ${scenes} -o ${WORK}/print
                  COMMAND_ERROR_IS_FATAL ANY)
  run(${cxx} "${flags} ${form}" ${WORK}/print)
endfunction()

function(check_library cxx library)
  file(GLOB scenes ${WORK}/scenes/*.o)
  get_filename_component(folder ${library} DIRECTORY)
  execute_process(COMMAND ${cxx} ${scenes} ${library} -Wl,-rpath,${folder} -o ${WORK}/print
                  COMMAND_ERROR_IS_FATAL ANY)
  file(RELATIVE_PATH path ${PACKAGE} ${library})
  run(${cxx} "of embed/package, ${path}" ${WORK}/print)
endfunction()

# Whether PACKAGE has the variants of separate sources of this compiler; checks them where it has.
function(check_package cxx)
  set(in_package FALSE PARENT_SCOPE)
  file(REAL_PATH ${cxx} path)
  file(REAL_PATH ${COMPILER} packaged)
  set(archive ${PACKAGE}/shared_OFF/build/libwireskin.a)
  set(shared ${PACKAGE}/shared_ON/build/libwireskin.so)
  if(path STREQUAL packaged AND EXISTS ${archive} AND EXISTS ${shared})
    check_library(${cxx} ${archive})
    check_library(${cxx} ${shared})
    set(in_package TRUE PARENT_SCOPE)
  endif()
endfunction()

# clang first: the separate sources are mostly tested with gcc.
if(NOT compilers)
  return()
endif()
list(GET compilers -1 quick)
if(TIER STREQUAL "quick")
  compile_scenes(${quick})
  check_variant(${quick} single -O0)
  return()
endif()
foreach(cxx IN LISTS compilers)
  compile_scenes(${cxx})
  check_variant(${cxx} single "-O3 ${fused}")
  check_package(${cxx})
  if(NOT in_package)
    check_variant(${cxx} separate -O0)
  elseif(NOT cxx STREQUAL quick)
    check_variant(${cxx} single -O0)
  endif()
endforeach()
