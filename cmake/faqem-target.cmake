# What all faqem targets share.

# In the names of shared libraries. Before 1.0 a minor version may break what was (CHANGELOG.md).
set(faqem_abi ${PROJECT_VERSION_MAJOR})
if(faqem_abi EQUAL 0)
    set(faqem_abi 0.${PROJECT_VERSION_MINOR})
endif()

# faqem_export(TARGET NAME): the target is faqem::NAME, here and in the installed package.
function(faqem_export target name)
    add_library(faqem::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "INTERFACE_LIBRARY")
        set(scope INTERFACE)
    else()
        set(scope PUBLIC)
        # Installed libraries find each other wherever the tree is moved to.
        set_target_properties(${target} PROPERTIES OUTPUT_NAME ${target} VERSION ${PROJECT_VERSION} SOVERSION ${faqem_abi}
                                                   INSTALL_RPATH "\$ORIGIN" DEFINE_SYMBOL "")
    endif()
    target_compile_features(${target} ${scope} cxx_std_20)
    target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()

# faqem_compile_options(TARGET): our warnings, and arithmetic that is the same everywhere.
function(faqem_compile_options target)
    target_compile_features(${target} PRIVATE cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                             -Woverloaded-virtual)
    if(FAQEM_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
endfunction()

# faqem_hide(TARGET MAP): of a shared library, what FAQEM_EXPORT marks and MAP names is all that is seen from outside.
function(faqem_hide target map)
    get_target_property(type ${target} TYPE)
    if(NOT type STREQUAL "SHARED_LIBRARY")
        return()
    endif()
    set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
                                               LINK_DEPENDS ${map})
    # What libraries instantiate of the standard library would be seen in spite of that.
    target_link_options(${target} PRIVATE -Wl,--version-script=${map})
endfunction()
