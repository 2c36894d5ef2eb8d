# Builds the fuzz targets by clang, with AddressSanitizer and UndefinedBehaviorSanitizer, in WORK.
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${ROOT} -B ${WORK} -DCMAKE_BUILD_TYPE=RelWithDebInfo
          "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O2 -g1" -DCMAKE_CXX_COMPILER=${CLANG}
          -DCMAKE_C_COMPILER=${CLANG_C} -DWIRESKIN_BUILD_FUZZERS=ON -DWIRESKIN_INSTALL=OFF
          -DWIRESKIN_SANITIZE=address,undefined
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK} --target fuzzers -j 2
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
