# Debian packages, made by `cpack -G DEB`: faqem (the command), libfaqem0.1 (shared libraries), libfaqem-dev
# (headers, static libraries and package files).
set(CPACK_PACKAGE_CONTACT "The faqem maintainers <faqem@localhost>")
set(CPACK_PACKAGE_VENDOR "")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL development)
set(CPACK_STRIP_FILES ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfaqem-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION}\n Headers, libraries, CMake package and pkg-config files.")
# Each is needed by one component of the CMake package. The component faqem needs none of them.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libeigen3-dev, libopenmesh-dev, \
libpng-dev, libjpeg62-turbo-dev, libwebp-dev, libdeflate-dev")
foreach(library IN LISTS faqem_decoders)
    string(APPEND CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS ", ${faqem_debian_${library}}")
endforeach()

if(FAQEM_BUILD_TOOL)
    list(APPEND CPACK_COMPONENTS_ALL tool)
    set(CPACK_DEBIAN_TOOL_PACKAGE_NAME faqem)
    set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION graphics)
    set(CPACK_COMPONENT_TOOL_DESCRIPTION "${PROJECT_DESCRIPTION}\n The command.")
endif()
if(FAQEM_BUILD_C OR BUILD_SHARED_LIBS)
    list(APPEND CPACK_COMPONENTS_ALL runtime)
    set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libfaqem${faqem_abi})
    set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
    set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "${PROJECT_DESCRIPTION}\n The shared libraries.")
    set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS runtime)
    set(CPACK_COMPONENT_TOOL_DEPENDS runtime)  # at least for the image plugin
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src/faqem ${PROJECT_BINARY_DIR}/src/asset
                                                    ${PROJECT_BINARY_DIR}/src/bake ${PROJECT_BINARY_DIR}/src/capi)
endif()

# Each package contains the licence.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
    string(TOUPPER ${component} upper)
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright COMPONENT ${component}
            DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
endforeach()

include(CPack)
