# The golden hashes on other processors, systems and byte orders: the single header is built by each
# cross compiler at hand and runs in an emulator. Says which targets it skipped; those that run must
# give the bits of golden.h.
cmake_minimum_required(VERSION 3.25)

set(sources ${ROOT}/tests/golden/golden_print.cpp ${ROOT}/tests/support/scenes.cpp
            ${ROOT}/tests/embed/implementation.cpp)
set(common -std=c++17 -O2 -ffp-contract=off -I${ROOT}/tests -I${WORK})
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
execute_process(
  COMMAND ${CMAKE_COMMAND} -DOUTPUT=${WORK}/wireskin.h -P ${ROOT}/single_include/amalgamate.cmake
  COMMAND_ERROR_IS_FATAL ANY)
set(ran 0)

# check_target(NAME compiler "flags" "emulator ..."): the emulator's first word is a program.
function(check_target name compiler flags emulator)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  separate_arguments(emulator UNIX_COMMAND "${emulator}")
  set(cxx_of_${name} cxx_of_${name}-NOTFOUND)
  find_program(cxx_of_${name} ${compiler})
  if(NOT cxx_of_${name})
    message(STATUS "${name}: skipped, ${compiler} is not here")
    return()
  endif()
  if(emulator)
    list(POP_FRONT emulator program)
    find_program(runner_of_${name} ${program} PATHS /usr/lib/wine)
    if(NOT runner_of_${name})
      message(STATUS "${name}: skipped, ${program} is not here")
      return()
    endif()
    list(PREPEND emulator ${runner_of_${name}})
  endif()
  execute_process(COMMAND ${cxx_of_${name}} ${common} ${flags} ${sources} -o ${WORK}/${name}.out
                  RESULT_VARIABLE built ERROR_VARIABLE errors)
  if(NOT built EQUAL 0)
    message(SEND_ERROR "${name}: does not build\n${errors}")
    return()
  endif()
  execute_process(COMMAND ${emulator} ${WORK}/${name}.out OUTPUT_VARIABLE text
                  RESULT_VARIABLE result ERROR_QUIET)
  if(result EQUAL 0)
    message(STATUS "${name}: equal")
    math(EXPR ran "${ran} + 1")
    set(ran ${ran} PARENT_SCOPE)
  else()
    message(SEND_ERROR "${name}: result ${result}, other bits than tests/golden/golden.h\n${text}")
  endif()
endfunction()

set(ENV{WINEDEBUG} -all)
set(ENV{WINEPREFIX} ${WORK}/wine)
check_target(i686 i686-linux-gnu-g++ "-msse2 -mfpmath=sse -static" "")
check_target(aarch64 aarch64-linux-gnu-g++ "-static" "qemu-aarch64-static")
check_target(armhf arm-linux-gnueabihf-g++ "-static" "qemu-arm-static")
check_target(s390x s390x-linux-gnu-g++ "-static" "qemu-s390x-static")
check_target(ppc64 powerpc64-linux-gnu-g++ "-static" "qemu-ppc64-static")
check_target(riscv64 riscv64-linux-gnu-g++ "-static" "qemu-riscv64-static")
check_target(windows x86_64-w64-mingw32-g++ "-static" "wine64")
if(EXISTS /usr/include/wasm32-wasi)
  check_target(wasm clang++-14 "--target=wasm32-wasi -fno-exceptions -Wl,-z,stack-size=1048576"
               "node --no-warnings ${ROOT}/tests/golden/run_wasi.mjs")
else()
  message(STATUS "wasm: skipped, wasi-libc is not here")
endif()
message(STATUS "${ran} targets ran")
