# The library as it ships (ARCHIVE, of package.cmake) needs no symbol of the C++ runtime, exports only
# the C API, has no writable global, and C programs link with it by the C compiler alone, also where
# another CMake project embeds it.
cmake_minimum_required(VERSION 3.25)
set(allowed
    memcpy memmove memset memcmp malloc free sqrt
    _GLOBAL_OFFSET_TABLE_)

# Unoptimised and as a unity build: what counts is that it configures and links.
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${ROOT}/tests/embed -B ${WORK} -DWIRESKIN_ROOT=${ROOT}
          -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O0
          -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=32
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK} -j 2
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${WORK}/embedder COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
set(archive ${ARCHIVE})

find_program(nm nm REQUIRED)
execute_process(COMMAND ${nm} -u ${archive} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${nm} -g --defined-only ${archive} OUTPUT_VARIABLE defined_text
                COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^ \n]+ [0-9a-f]* *[TDRBVW] [^\n]*|[0-9a-f]+ [TDRBVW] [^\n]+" defined "${defined_text}")
string(REGEX MATCHALL " U [^\n]+" undefined "${text}")
list(TRANSFORM undefined REPLACE "^ U " "")
list(TRANSFORM defined REPLACE "^.* [TDRBVW] " "")
list(REMOVE_DUPLICATES undefined)
list(LENGTH defined count)
if(count LESS 10)
  message(SEND_ERROR "only ${count} defined symbols were seen; this test reads nothing")
endif()
foreach(symbol IN LISTS undefined)
  if(NOT symbol IN_LIST allowed AND NOT symbol IN_LIST defined)
    message(SEND_ERROR "the library needs the symbol ${symbol}")
  endif()
endforeach()
foreach(symbol IN LISTS defined)
  if(NOT symbol MATCHES "^(wsk_|_ZN[A-Z0-9]*8wireskin|_Z[A-Z]*N[A-Z]*8wireskin)")
    message(SEND_ERROR "the library defines the symbol ${symbol} outside its namespace")
  endif()
endforeach()

# No writable global: nothing in .data, .bss or thread-local sections (constant tables that hold
# addresses lie in .data.rel.ro, which the loader closes).
find_program(objdump objdump REQUIRED)
execute_process(COMMAND ${objdump} -t ${archive} OUTPUT_VARIABLE table COMMAND_ERROR_IS_FATAL ANY)
if(NOT table MATCHES " O \\.rodata")
  message(SEND_ERROR "no constant table was seen; this test reads nothing")
endif()
string(REGEX MATCHALL "[^\n]* O [.*](data|bss|tdata|tbss|COM)[^\n]*" objects "${table}")
list(FILTER objects EXCLUDE REGEX " \\.data\\.rel\\.ro")
foreach(object IN LISTS objects)
  message(SEND_ERROR "a writable global: ${object}")
endforeach()

# The C programs: the strict C89 one and the example of the README.
find_program(cc NAMES cc gcc clang REQUIRED)
file(GLOB programs ${ROOT}/tests/embed/c89_user.c ${ROOT}/examples/c/*.c)
foreach(program IN LISTS programs)
  get_filename_component(name ${program} NAME_WE)
  execute_process(COMMAND ${cc} -I${ROOT}/src ${program} ${archive} -lm -o ${WORK}/${name}
                  COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${WORK}/${name} WORKING_DIRECTORY ${WORK} OUTPUT_QUIET
                  RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(SEND_ERROR "${name} returned ${result}")
  endif()
endforeach()
