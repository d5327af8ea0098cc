# Installs headers, libraries, the command and the CMake package.
include(CMakePackageConfigHelpers)

set(faqem_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/faqem)
install(TARGETS ${faqem_exported_targets} EXPORT faqem-targets)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/faqem DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT faqem-targets NAMESPACE faqem:: DESTINATION ${faqem_config_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/faqem-config.cmake.in
                              ${PROJECT_BINARY_DIR}/faqem-config.cmake INSTALL_DESTINATION ${faqem_config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/faqem-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/faqem-config.cmake ${PROJECT_BINARY_DIR}/faqem-config-version.cmake
              ${PROJECT_SOURCE_DIR}/cmake/faqem-dependencies.cmake DESTINATION ${faqem_config_dir})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
