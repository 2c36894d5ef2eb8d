# Builds in WORK, by clang with AddressSanitizer and UndefinedBehaviorSanitizer: the tests that the
# preset `sanitize` has, and the fuzz targets, which share the library with them.
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${ROOT} -B ${WORK} -DCMAKE_BUILD_TYPE=RelWithDebInfo
          "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -g1" -DCMAKE_CXX_COMPILER=${CLANG}
          "-DCMAKE_C_FLAGS_RELWITHDEBINFO=-O2 -g1" -DCMAKE_C_COMPILER=${CLANG_C}
          -DCMAKE_UNITY_BUILD=ON -DWIRESKIN_BUILD_FUZZERS=ON -DWIRESKIN_INSTALL=OFF -DWIRESKIN_DEBUG=ON
          -DWIRESKIN_SANITIZE=address,undefined -DWIRESKIN_TEST_DATA=${DATA}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK} --target sanitize_tests fuzzers -j 2
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
