# The viewer (export/preview, TypeScript) as one HTML page inside the program: esbuild bundles it, ld makes an object of it,
# and the object is part of aerogram_export. Users need no Node; building from source does (./bootstrap installs it).
find_program(NODE node REQUIRED)
find_program(NPM npm REQUIRED)
set(preview_source "${PROJECT_SOURCE_DIR}/export/preview")
set(preview_build "${PROJECT_BINARY_DIR}/preview")
file(GLOB preview_files CONFIGURE_DEPENDS "${preview_source}/src/*" "${preview_source}/*.mjs" "${preview_source}/tsconfig.json")
file(MAKE_DIRECTORY "${preview_build}")

add_custom_command(
    OUTPUT "${preview_build}/installed.stamp"
    COMMAND "${CMAKE_COMMAND}" -DPREVIEW=${preview_source} -DNPM=${NPM} -P "${PROJECT_SOURCE_DIR}/cmake/InstallPreviewPackages.cmake"
    COMMAND "${CMAKE_COMMAND}" -E touch "${preview_build}/installed.stamp"
    DEPENDS "${preview_source}/package.json" "${preview_source}/package-lock.json" "${PROJECT_SOURCE_DIR}/cmake/InstallPreviewPackages.cmake"
    COMMENT "npm packages of the viewer" VERBATIM)
add_custom_command(
    OUTPUT "${preview_build}/viewer.html"
    COMMAND "${NODE}" "${preview_source}/build.mjs" "${preview_build}/viewer.html"
    DEPENDS "${preview_build}/installed.stamp" ${preview_files}
    COMMENT "Bundling the viewer" VERBATIM)
add_custom_command(  # the symbols are named after the file: _binary_viewer_html_start, _end
    OUTPUT "${preview_build}/viewer.o"
    COMMAND "${CMAKE_LINKER}" -r -b binary -z noexecstack -o viewer.o viewer.html
    DEPENDS "${preview_build}/viewer.html" WORKING_DIRECTORY "${preview_build}" VERBATIM)
set(AEROGRAM_VIEWER_OBJECT "${preview_build}/viewer.o")
