# The golden hashes on another processor, system or byte order: the single header is built by the cross
# compiler of MACHINE and runs in an emulator; it must give the bits of golden.h. Says what is missing
# where it cannot. The object for wasm serves embed/links and languages/javascript too.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)

# check_target(NAME compiler "flags" "emulator ..."): the emulator's first word is a program.
function(check_target name compiler flags emulator)
  if(NOT name STREQUAL MACHINE)
    return()
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  separate_arguments(emulator UNIX_COMMAND "${emulator}")
  list(POP_FRONT emulator program)
  look_for(${name} ${compiler} ${program})
  if(NOT found)
    return()
  endif()
  execute_process(
    COMMAND ${compiler} -std=c++17 ${flags} -fno-exceptions -fno-rtti -fno-threadsafe-statics
            -I${WORK} -c ${implementation} -o ${WORK}/library.o
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(
    COMMAND ${compiler} -std=c++17 ${flags} -O1 -ffp-contract=off -I${ROOT}/tests -I${WORK}
            ${golden_sources} ${WORK}/library.o -o ${WORK}/print.exe
    COMMAND_ERROR_IS_FATAL ANY)
  if(program)
    list(PREPEND emulator ${${program}_path})
  endif()
  must(${name} ${emulator} ${WORK}/print.exe)  # a name that every system runs
endfunction()

# The level of optimisation differs, as between those who embed the library.
set(ENV{WINEDEBUG} -all)
set(ENV{WINEPREFIX} ${WORK}/wine)
check_target(i686 i686-linux-gnu-g++ "-O1 -msse2 -mfpmath=sse -static" "")
check_target(aarch64 aarch64-linux-gnu-g++ "-O1 -static" "qemu-aarch64-static")
check_target(armhf arm-linux-gnueabihf-g++ "-O0 -static" "qemu-arm-static")
check_target(s390x s390x-linux-gnu-g++ "-O1 -static" "qemu-s390x-static")
check_target(ppc64 powerpc64-linux-gnu-g++ "-O0 -static" "qemu-ppc64-static")
check_target(riscv64 riscv64-linux-gnu-g++ "-O0 -static" "qemu-riscv64-static")
check_target(windows x86_64-w64-mingw32-g++ "-O1 -static" "wine64")
if(EXISTS /usr/include/wasm32-wasi OR NOT MACHINE STREQUAL "wasm")
  check_target(wasm clang++-14 "-O2 --target=wasm32-wasi -fno-exceptions"
               "node --no-warnings ${ROOT}/tests/golden/run_wasi.mjs")
else()
  message(STATUS "wasm: skipped, wasi-libc is not here")
endif()

# A C program on Windows links the same object without any C++ runtime.
if(MACHINE STREQUAL "windows" AND EXISTS ${WORK}/library.o)
  look_for(mingw x86_64-w64-mingw32-gcc)
  if(found)
    execute_process(COMMAND x86_64-w64-mingw32-gcc -I${WORK} ${ROOT}/tests/embed/c89_user.c
                            ${WORK}/library.o -o ${WORK}/user.exe COMMAND_ERROR_IS_FATAL ANY)
    find_program(wine wine64 PATHS /usr/lib/wine)
    must("mingw, a C program" ${wine} ${WORK}/user.exe)
  endif()
endif()
