# The golden hashes come out the same from every compiler at hand, unoptimised and optimised, with and
# without fused multiply-add. Each compiler builds the single header, which gets no flag that keeps
# floating point strict: it must do so itself. TIER=quick builds one of the variants, TIER=full the
# others. Of COMPILER the test golden_single has the single header at -O2, with fused multiply-add, and
# PACKAGE, the folder of embed/package, the library from separate sources, optimised; clang's separate
# sources run the golden tests in the sanitized build.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
include(${ROOT}/tests/embed/find_compilers.cmake)
include(${ROOT}/tests/golden/fused.cmake)

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

function(check_variant cxx flags)
  separate_arguments(flag_list UNIX_COMMAND "${flags}")
  file(GLOB scenes ${WORK}/scenes/*.o)
  execute_process(COMMAND ${cxx} -std=c++17 ${flag_list} -I${WORK} ${implementation} ${scenes}
                          -o ${WORK}/print
                  COMMAND_ERROR_IS_FATAL ANY)
  run(${cxx} "${flags}" ${WORK}/print)
endfunction()

function(check_library cxx library)
  file(GLOB scenes ${WORK}/scenes/*.o)
  get_filename_component(folder ${library} DIRECTORY)
  execute_process(COMMAND ${cxx} ${scenes} ${library} -Wl,-rpath,${folder} -o ${WORK}/print
                  COMMAND_ERROR_IS_FATAL ANY)
  file(RELATIVE_PATH path ${PACKAGE} ${library})
  run(${cxx} "of embed/package, ${path}" ${WORK}/print)
endfunction()

# Sets `packaged`: whether PACKAGE has libraries of this compiler.
function(check_package cxx)
  file(REAL_PATH ${cxx} path)
  file(REAL_PATH ${COMPILER} path_of_package)
  set(archive ${PACKAGE}/shared_OFF/build/libwireskin.a)
  set(shared ${PACKAGE}/shared_ON/build/libwireskin.so)
  set(packaged FALSE)
  if(path STREQUAL path_of_package AND EXISTS ${archive} AND EXISTS ${shared})
    check_library(${cxx} ${archive})
    check_library(${cxx} ${shared})
    set(packaged TRUE)
  endif()
  set(packaged ${packaged} PARENT_SCOPE)
endfunction()

if(NOT compilers)
  return()
endif()
list(GET compilers -1 quick)
if(TIER STREQUAL "quick")
  compile_scenes(${quick})
  check_variant(${quick} -O0)
  return()
endif()
foreach(cxx IN LISTS compilers)
  compile_scenes(${cxx})
  check_package(${cxx})
  if(NOT packaged)
    check_variant(${cxx} "-O3 ${fused}")
  endif()
  if(NOT cxx STREQUAL quick)
    check_variant(${cxx} -O0)
  endif()
endforeach()
