# The golden hashes come out the same from every compiler at hand, unoptimised and optimised, from
# separate sources and from the single header (which gets no flag that keeps floating point strict:
# it must do so itself). TIER=quick builds one of the variants, TIER=full four by each compiler.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
include(${ROOT}/tests/embed/find_compilers.cmake)

file(GLOB_RECURSE sources ${ROOT}/src/*.cpp)

# Where the processor has fused multiply-add, the compiler is allowed to use it and must not.
set(fused "")
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo flags REGEX "^flags.* fma .* avx2 |^flags.* avx2 .* fma " LIMIT_COUNT 1)
  if(flags)
    set(fused "-O3 -mavx2 -mfma")
  endif()
endif()

function(check_variant cxx form flags)
  get_filename_component(name ${cxx} NAME)
  separate_arguments(flag_list UNIX_COMMAND "${flags}")
  # The scenes are input: their arithmetic must not be contracted either.
  set(strict ${golden_sources} -I${ROOT}/tests -ffp-contract=off)
  if(form STREQUAL "single")
    execute_process(
      COMMAND ${cxx} -std=c++17 ${flag_list} -I${WORK} -c ${implementation}
              -o ${WORK}/implementation.o
      COMMAND_ERROR_IS_FATAL ANY)
    set(library -I${WORK} ${WORK}/implementation.o)
  else()
    set(library -I${ROOT}/src ${sources})
  endif()
  execute_process(COMMAND ${cxx} -std=c++17 ${flag_list} ${library} ${strict} -o ${WORK}/print
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${WORK}/print --arrays OUTPUT_VARIABLE text RESULT_VARIABLE result)
  if(result EQUAL 0)
    message(STATUS "${name} ${flags} ${form}: equal")
  else()
    message(SEND_ERROR "${name} ${flags} ${form}: other bits than tests/golden/golden.h\n${text}")
  endif()
endfunction()

if(TIER STREQUAL "quick")
  list(REVERSE compilers)  # clang first: the separate sources are mostly tested with gcc
  foreach(cxx IN LISTS compilers)
    check_variant(${cxx} single -O0)
    break()
  endforeach()
else()
  foreach(cxx IN LISTS compilers)
    check_variant(${cxx} single -O0)
    check_variant(${cxx} separate -O3)
    foreach(form single separate)
      if(fused)
        check_variant(${cxx} ${form} "${fused}")
      endif()
    endforeach()
  endforeach()
endif()
