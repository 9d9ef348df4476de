# Runs npm ci in the viewer's folder unless its packages are those of the lockfile already.
set(stamp "${PREVIEW}/node_modules/.installed-lock.json")
execute_process(COMMAND "${CMAKE_COMMAND}" -E compare_files "${stamp}" "${PREVIEW}/package-lock.json" RESULT_VARIABLE differs
                OUTPUT_QUIET ERROR_QUIET)
if(differs)
    execute_process(COMMAND "${NPM}" ci --no-audit --no-fund --loglevel=error WORKING_DIRECTORY "${PREVIEW}" RESULT_VARIABLE failed)
    if(failed)
        message(FATAL_ERROR "npm ci failed in ${PREVIEW}")
    endif()
    file(COPY_FILE "${PREVIEW}/package-lock.json" "${stamp}")
endif()
