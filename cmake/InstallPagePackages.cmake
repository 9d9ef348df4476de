# Runs npm ci in a page's folder unless its packages are those of the lockfile already.
set(stamp "${PAGE}/node_modules/.installed-lock.json")
execute_process(COMMAND "${CMAKE_COMMAND}" -E compare_files "${stamp}" "${PAGE}/package-lock.json" RESULT_VARIABLE differs
                OUTPUT_QUIET ERROR_QUIET)
if(differs)
    execute_process(COMMAND "${NPM}" ci --no-audit --no-fund --loglevel=error WORKING_DIRECTORY "${PAGE}" RESULT_VARIABLE failed)
    if(failed)
        message(FATAL_ERROR "npm ci failed in ${PAGE}")
    endif()
    file(COPY_FILE "${PAGE}/package-lock.json" "${stamp}")
endif()
