# Installs headers, libraries and the CMake package. Each component has its own export set, so that users of
# the component faqem need neither OpenMesh nor image libraries.
include(CMakePackageConfigHelpers)

set(faqem_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/faqem)
foreach(component IN LISTS faqem_components)
    install(TARGETS faqem_${component} EXPORT faqem-${component}-targets
            ARCHIVE COMPONENT development
            LIBRARY COMPONENT runtime NAMELINK_COMPONENT development)
    install(EXPORT faqem-${component}-targets NAMESPACE faqem:: DESTINATION ${faqem_config_dir} COMPONENT development)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/faqem DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/faqem-config.cmake.in
                              ${PROJECT_BINARY_DIR}/faqem-config.cmake INSTALL_DESTINATION ${faqem_config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/faqem-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/faqem-config.cmake ${PROJECT_BINARY_DIR}/faqem-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/faqem-dependencies.cmake DESTINATION ${faqem_config_dir} COMPONENT development)
include(faqem-pkg-config)
include(faqem-packages)
