# aerogram_page(MODULE SOURCE NAME)
# A web page (TypeScript) inside the program: esbuild bundles SOURCE into NAME.html, ld makes an object of it, and the object
# becomes part of MODULE, which finds it as _binary_NAME_html_start and _end. SOURCE holds package.json, package-lock.json,
# tsconfig.json and src/ (see bundle_page.mjs). Users need no Node; building from source does (./bootstrap installs it).
find_program(NODE node REQUIRED)
find_program(NPM npm REQUIRED)

function(aerogram_page module source name)
    set(source "${PROJECT_SOURCE_DIR}/${source}")
    set(build "${PROJECT_BINARY_DIR}/pages/${name}")
    set(bundler "${PROJECT_SOURCE_DIR}/cmake/bundle_page.mjs")
    set(installer "${PROJECT_SOURCE_DIR}/cmake/InstallPagePackages.cmake")
    file(GLOB files CONFIGURE_DEPENDS "${source}/src/*" "${source}/tsconfig.json")
    file(MAKE_DIRECTORY "${build}")
    add_custom_command(
        OUTPUT "${build}/installed.stamp"
        COMMAND "${CMAKE_COMMAND}" -DPAGE=${source} -DNPM=${NPM} -P "${installer}"
        COMMAND "${CMAKE_COMMAND}" -E touch "${build}/installed.stamp"
        DEPENDS "${source}/package.json" "${source}/package-lock.json" "${installer}"
        COMMENT "npm packages of ${name}.html" VERBATIM)
    add_custom_command(
        OUTPUT "${build}/${name}.html"
        COMMAND "${NODE}" "${bundler}" "${source}" "${build}/${name}.html"
        DEPENDS "${build}/installed.stamp" "${bundler}" ${files}
        COMMENT "Bundling ${name}.html" VERBATIM)
    add_custom_command(  # the symbols are named after the file
        OUTPUT "${build}/${name}.o"
        COMMAND "${CMAKE_LINKER}" -r -b binary -z noexecstack -o ${name}.o ${name}.html
        DEPENDS "${build}/${name}.html" WORKING_DIRECTORY "${build}" VERBATIM)
    string(REPLACE "/" "_" target "aerogram_${module}")
    target_sources(${target} PRIVATE "${build}/${name}.o")
endfunction()
