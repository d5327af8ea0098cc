# The pkg-config files faqem (C++20 library for arrays) and faqem-c (C interface). The components that depend
# on image libraries are available only through CMake.

# faqem_install_pc(NAME DESCRIPTION LIBS) installs NAME.pc.
function(faqem_install_pc faqem_pc_name faqem_pc_description faqem_pc_libs)
    set(faqem_pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
    file(RELATIVE_PATH faqem_pc_to_prefix /prefix/${faqem_pc_dir} /prefix)
    string(REGEX REPLACE "/$" "" faqem_pc_to_prefix ${faqem_pc_to_prefix})
    configure_file(${PROJECT_SOURCE_DIR}/cmake/faqem.pc.in ${PROJECT_BINARY_DIR}/${faqem_pc_name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/${faqem_pc_name}.pc DESTINATION ${faqem_pc_dir} COMPONENT development)
endfunction()

faqem_install_pc(faqem "${PROJECT_DESCRIPTION}" "-lfaqem -pthread")
if(FAQEM_BUILD_C)
    faqem_install_pc(faqem-c "${PROJECT_DESCRIPTION} (C)" "-lfaqem_c")
endif()
