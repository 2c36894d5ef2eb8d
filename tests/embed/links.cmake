# Who can link the library (ARCHIVE, as it ships): C programs by tcc, gcc in strict C89 and musl (mingw:
# golden/cross.cmake); a WebAssembly module that imports nothing (of WASM_OBJECT, which golden/cross/wasm
# makes); and how large it is for a Cortex-M4: not larger than `most_text`, which whoever adds code has
# to raise knowingly. Toolchains that are not here are skipped by name.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
set(user ${ROOT}/tests/embed/c89_user.c)
set(most_text 512000)

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
look_for(wasm clang-14 node)
if(found AND NOT EXISTS ${WASM_OBJECT})
  message(STATUS "wasm: skipped, golden/cross/wasm has built no object")
elseif(found)
  execute_process(COMMAND clang-14 --target=wasm32-wasi -mexec-model=reactor ${WASM_OBJECT} -lm
                          -Wl,--export=wsk_build -Wl,--export=malloc -Wl,--export=free
                          -Wl,--export=wsk_version_string -Wl,-s -o ${WORK}/wireskin.wasm
                  COMMAND_ERROR_IS_FATAL ANY)
  must("wasm without imports" node ${ROOT}/tests/embed/no_imports.mjs ${WORK}/wireskin.wasm)
  file(SIZE ${WORK}/wireskin.wasm bytes)
  message(STATUS "wasm at -O2: ${bytes} bytes")
endif()

look_for("Cortex-M4" arm-none-eabi-g++ arm-none-eabi-size)
if(found)
  execute_process(COMMAND arm-none-eabi-g++ -std=c++17 -Os -fno-exceptions -fno-rtti
                          -fno-threadsafe-statics -I${WORK} -mcpu=cortex-m4 -mthumb
                          -mfpu=fpv4-sp-d16 -mfloat-abi=hard -ffunction-sections
                          -c ${implementation} -o ${WORK}/library_m4.o
                  RESULT_VARIABLE result ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "Cortex-M4: does not compile\n${text}")
  else()
    execute_process(COMMAND arm-none-eabi-size ${WORK}/library_m4.o OUTPUT_VARIABLE text)
    string(REGEX MATCH "\n *([0-9]+)" text "${text}")
    message(STATUS "Cortex-M4 at -Os: ${CMAKE_MATCH_1} bytes of text")
    if(CMAKE_MATCH_1 GREATER most_text)
      message(SEND_ERROR "the library has grown beyond ${most_text} bytes of text")
    endif()
  endif()
endif()
