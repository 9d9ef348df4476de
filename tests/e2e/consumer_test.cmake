# Installs the build into an empty prefix, builds tests/e2e/consumer against nothing but that prefix, and runs it.
# cmake -D BUILD=<build tree> -D SOURCE=<source tree> -D WORK=<folder> -D BUILD_TYPE=... -D LAUNCHER=... -P consumer_test.cmake
foreach(folder IN ITEMS prefix build)
    file(REMOVE_RECURSE "${WORK}/${folder}")
endforeach()
function(run)
    execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
# Moved, so that a path into the first prefix would be noticed.
file(REMOVE_RECURSE "${WORK}/moved")
file(RENAME "${WORK}/prefix" "${WORK}/moved")
run("${CMAKE_COMMAND}" -S "${SOURCE}/tests/e2e/consumer" -B "${WORK}/build" -G Ninja "-DCMAKE_BUILD_TYPE=${BUILD_TYPE}"
    "-DCMAKE_PREFIX_PATH=${WORK}/moved" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}" "-DCMAKE_CXX_FLAGS=${FLAGS}")
run("${CMAKE_COMMAND}" --build "${WORK}/build")
run("${WORK}/build/consumer" "${SOURCE}/missions/the-end.toml")
