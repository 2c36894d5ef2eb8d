# Who can link the library (ARCHIVE, as it ships): C programs by tcc, gcc in strict C89 and musl (mingw:
# golden/cross.cmake); a WebAssembly module that imports nothing; and how large it is for a Cortex-M4.
# Toolchains that are not here are skipped by name.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
set(user ${ROOT}/tests/embed/c89_user.c)
set(library_flags -std=c++17 -O1 -fno-exceptions -fno-rtti -fno-threadsafe-statics -I${WORK})

# C programs on this machine, each by a compiler of its own.
foreach(compiler "tcc" "gcc -std=c89 -pedantic-errors" "musl-gcc -static")
  separate_arguments(words UNIX_COMMAND "${compiler}")
  list(GET words 0 program)
  look_for("${compiler}" ${program})
  if(NOT found)
    continue()
  endif()
  execute_process(COMMAND ${words} -I${WORK} ${user} ${ARCHIVE} -lm -o ${WORK}/user
                  RESULT_VARIABLE result ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "${compiler}: does not link\n${text}")
    continue()
  endif()
  must("${compiler}" ${WORK}/user)
endforeach()

# A module without a host: nothing is imported, a page or a script may instantiate it with {}.
look_for(wasm clang++-14 clang-14 node)
if(found AND NOT EXISTS /usr/include/wasm32-wasi)
  message(STATUS "wasm: skipped, wasi-libc is not here")
elseif(found)
  set(wasm_flags --target=wasm32-wasi -mexec-model=reactor -Wl,--export=wsk_build
      -Wl,--export=malloc -Wl,--export=free -Wl,--export=wsk_version_string -Wl,-s)
  execute_process(COMMAND clang++-14 --target=wasm32-wasi ${library_flags} -Oz -c ${implementation}
                          -o ${WORK}/library_wasm.o COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND clang-14 ${wasm_flags} ${WORK}/library_wasm.o -lm -o ${WORK}/wireskin.wasm
                  COMMAND_ERROR_IS_FATAL ANY)
  must("wasm without imports" node ${ROOT}/tests/embed/no_imports.mjs ${WORK}/wireskin.wasm)
  file(SIZE ${WORK}/wireskin.wasm bytes)
  message(STATUS "wasm at -Oz: ${bytes} bytes")
endif()

look_for("Cortex-M4" arm-none-eabi-g++ arm-none-eabi-size)
if(found)
  execute_process(COMMAND arm-none-eabi-g++ ${library_flags} -Os -mcpu=cortex-m4 -mthumb
                          -mfpu=fpv4-sp-d16 -mfloat-abi=hard -ffunction-sections
                          -c ${implementation} -o ${WORK}/library_m4.o
                  RESULT_VARIABLE result ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "Cortex-M4: does not compile\n${text}")
  else()
    execute_process(COMMAND arm-none-eabi-size ${WORK}/library_m4.o OUTPUT_VARIABLE text)
    string(REGEX MATCH "\n *([0-9]+)" text "${text}")
    message(STATUS "Cortex-M4 at -Os: ${CMAKE_MATCH_1} bytes of text")
  endif()
endif()
