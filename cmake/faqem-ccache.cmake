# Compiles through ccache in a top-level build, if it is installed and its folder can be written. Objects are shared
# between clones and folders: paths below the source folder are made relative, and the build folder is not part of the
# key. They are shared between the presets release and test, too: -Werror does not change an object, and a compilation
# that fails is not stored. Precompiled headers need the sloppiness (and -fpch-preprocess, tests/CMakeLists.txt).
option(FAQEM_CCACHE "Compile through ccache if it is found" ${PROJECT_IS_TOP_LEVEL})

find_program(FAQEM_CCACHE_PROGRAM ccache)
mark_as_advanced(FAQEM_CCACHE_PROGRAM)
if(NOT FAQEM_CCACHE OR NOT FAQEM_CCACHE_PROGRAM OR CMAKE_CXX_COMPILER_LAUNCHER)
    return()
endif()

# ccache fails, instead of compiling without a cache, if it cannot write to its folder.
execute_process(COMMAND ${FAQEM_CCACHE_PROGRAM} --get-config cache_dir OUTPUT_VARIABLE faqem_cache_dir
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(faqem_probe "${faqem_cache_dir}/faqem-is-writable")
foreach(faqem_step IN ITEMS "make_directory;${faqem_cache_dir}" "touch;${faqem_probe}" "rm;${faqem_probe}")
    execute_process(COMMAND ${CMAKE_COMMAND} -E ${faqem_step} RESULT_VARIABLE faqem_result OUTPUT_QUIET ERROR_QUIET)
    if(NOT faqem_result EQUAL 0)
        break()
    endif()
endforeach()
if(NOT faqem_cache_dir OR NOT faqem_result EQUAL 0)
    message(WARNING "ccache is not used, because its folder '${faqem_cache_dir}' cannot be written. Set CCACHE_DIR to a "
                    "folder that can, or FAQEM_CCACHE=OFF.")
    return()
endif()
set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
                                CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_IGNOREOPTIONS=-Werror
                                ${FAQEM_CCACHE_PROGRAM})
set(CMAKE_C_COMPILER_LAUNCHER ${CMAKE_CXX_COMPILER_LAUNCHER})
