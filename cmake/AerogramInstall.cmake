# What `cmake --install` leaves: bin/aerogram, the libraries with their headers, and the package that find_package(aerogram)
# reads. Programs link aerogram::planner, aerogram::export or any single module (planner/motion is aerogram::planner_motion)
# and include <planner/plan.hpp> as we do.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/aerogram")

get_property(folders GLOBAL PROPERTY AEROGRAM_MODULES)
list(FILTER folders EXCLUDE REGEX "^ground/")  # the command itself, not a library
foreach(folder IN LISTS folders)
    string(REPLACE "/" "_" name "aerogram_${folder}")
    install(TARGETS ${name} EXPORT aerogram_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    file(GLOB headers CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.hpp")
    install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/aerogram/${folder}")
endforeach()
if(TARGET aerogram)
    install(TARGETS aerogram RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(EXPORT aerogram_targets NAMESPACE aerogram:: DESTINATION ${package_dir})
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/aerogram-config.cmake.in" "${PROJECT_BINARY_DIR}/aerogram-config.cmake"
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/aerogram-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/aerogram-config.cmake" "${PROJECT_BINARY_DIR}/aerogram-config-version.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/AerogramDependencies.cmake" DESTINATION ${package_dir})
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/aerogram")
