# The stack that the library needs at most: 48 KiB on the deepest path through it, callbacks apart, and
# no recursion.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/embed/start.cmake)
look_for(stack python3 g++)
if(found)
  execute_process(
    COMMAND g++ -std=c++17 -O2 -fno-exceptions -fno-rtti -fcallgraph-info=su -I${WORK}
            -c ${implementation} -o ${WORK}/library.o
    WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND python3 ${ROOT}/tests/embed/stack.py ${WORK}/library.ci 49152
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
