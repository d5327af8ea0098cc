# Functions that set the common properties of faqem's targets.

# ABI version in the names of shared libraries. Before 1.0, minor versions may be incompatible (CHANGELOG.md).
set(faqem_abi ${PROJECT_VERSION_MAJOR})
if(faqem_abi EQUAL 0)
    set(faqem_abi 0.${PROJECT_VERSION_MINOR})
endif()

# faqem_export(TARGET NAME) makes the target available as faqem::NAME, here and in the installed package.
function(faqem_export target name)
    add_library(faqem::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "INTERFACE_LIBRARY")
        set(scope INTERFACE)
    else()
        set(scope PUBLIC)
        # INSTALL_RPATH is relative, so that an installed tree can be moved.
        set_target_properties(${target} PROPERTIES OUTPUT_NAME ${target} VERSION ${PROJECT_VERSION} SOVERSION ${faqem_abi}
                                                   INSTALL_RPATH "\$ORIGIN" DEFINE_SYMBOL "")
    endif()
    target_compile_features(${target} ${scope} cxx_std_20)
    target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()

# faqem_compile_options(TARGET) enables warnings, and disables fused multiply-add for reproducible results.
function(faqem_compile_options target)
    target_compile_features(${target} PRIVATE cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                             -Woverloaded-virtual)
    if(WIN32)
        # Windows 10; sizes of files in 64 bits.
        target_compile_definitions(${target} PRIVATE _WIN32_WINNT=0x0A00 _FILE_OFFSET_BITS=64)
    endif()
    if(FAQEM_WERROR)
        # The false alarms of this warning depend on what is inlined, and differ between versions of g++.
        target_compile_options(${target} PRIVATE -Werror -Wno-error=array-bounds)
    endif()
endfunction()

# faqem_hide(TARGET MAP): a shared library exports only symbols that are marked with FAQEM_EXPORT and listed
# in the version script MAP.
function(faqem_hide target map)
    get_target_property(type ${target} TYPE)
    if(NOT type STREQUAL "SHARED_LIBRARY")
        return()
    endif()
    set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
                                               LINK_DEPENDS ${map})
    # The version script hides instantiations of the standard library, which have default visibility.
    target_link_options(${target} PRIVATE -Wl,--version-script=${map})
endfunction()

# faqem_add_image_plugin(TARGET NAME FILE) adds the plugin NAME.so, which asset/image/image_plugin.cpp loads.
function(faqem_add_image_plugin target name file)
    set(map ${PROJECT_SOURCE_DIR}/src/image_plugin/module.map)
    add_library(${target} MODULE ${file})
    faqem_compile_options(${target})
    set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name} CXX_VISIBILITY_PRESET hidden
                                               VISIBILITY_INLINES_HIDDEN ON LINK_DEPENDS ${map})
    target_link_options(${target} PRIVATE -Wl,--version-script=${map})
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
    target_compile_definitions(${target} PRIVATE FAQEM_VERSION="${PROJECT_VERSION}")

    # In the build tree it is found in the folder of the program or shared library that contains faqem_asset.
    set(folders "")
    set(component development)
    if(TARGET faqem_cli)
        list(APPEND folders $<TARGET_FILE_DIR:faqem_cli>)
        set(component tool)
    endif()
    if(TARGET faqem_c)
        list(APPEND folders $<TARGET_FILE_DIR:faqem_c>)
    endif()
    if(BUILD_SHARED_LIBS)
        list(APPEND folders $<TARGET_FILE_DIR:faqem_asset>)
    endif()
    if(TARGET faqem_c OR BUILD_SHARED_LIBS)
        set(component runtime)
    endif()
    foreach(folder IN LISTS folders)
        add_custom_command(TARGET ${target} POST_BUILD VERBATIM
                           COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
                           COMMAND ${CMAKE_COMMAND} -E copy $<TARGET_FILE:${target}> ${folder})
    endforeach()
    foreach(user IN ITEMS faqem_cli faqem_c)
        if(TARGET ${user})
            add_dependencies(${user} ${target})
        endif()
    endforeach()
    if(FAQEM_INSTALL)
        install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/faqem COMPONENT ${component})
    endif()
endfunction()
