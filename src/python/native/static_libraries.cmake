# Libraries for the wheel, linked statically, so that it runs on machines without them. Included after project() by the
# preset wheel (CMAKE_PROJECT_faqem_INCLUDE): faqem uses the targets that exist already, and finds static archives for
# the others. Debian 12 offers no archive of meshoptimizer, which is compiled from Debian's source package.
set(CMAKE_FIND_LIBRARY_SUFFIXES .a)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(faqem_native ${CMAKE_CURRENT_LIST_DIR})
include(${PROJECT_SOURCE_DIR}/cmake/faqem-ccache.cmake)

# libgcc_s stays shared: the static one needs glibc 2.35. Every system has it, and the platform tag allows it.
add_link_options(-static-libstdc++ -Wl,--wrap=arc4random,--wrap=stderr,--undefined=__wrap_arc4random -Wl,--strip-all)
add_library(faqem_glibc STATIC ${faqem_native}/glibc.cpp)
link_libraries(faqem_glibc)

find_path(FAQEM_DRACO_INCLUDE_DIR draco/compression/decode.h REQUIRED)
find_library(FAQEM_DRACO_LIBRARY draco REQUIRED)
add_library(draco::draco STATIC IMPORTED)
set_target_properties(draco::draco PROPERTIES IMPORTED_LOCATION ${FAQEM_DRACO_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${FAQEM_DRACO_INCLUDE_DIR})

set(faqem_meshoptimizer ${PROJECT_BINARY_DIR}/meshoptimizer)
if(NOT EXISTS ${faqem_meshoptimizer}/src/meshoptimizer.h)
    execute_process(COMMAND ${PROJECT_SOURCE_DIR}/cmake/fetch-sources.sh ${PROJECT_BINARY_DIR} meshoptimizer
                    COMMAND_ERROR_IS_FATAL ANY)
endif()
file(GLOB faqem_meshoptimizer_files ${faqem_meshoptimizer}/src/*.cpp)
add_library(faqem_meshoptimizer STATIC ${faqem_meshoptimizer_files})
target_compile_options(faqem_meshoptimizer PRIVATE -ffp-contract=off)  # the same bytes on all processors
set_target_properties(faqem_meshoptimizer PROPERTIES UNITY_BUILD OFF)
target_include_directories(faqem_meshoptimizer SYSTEM PUBLIC ${faqem_meshoptimizer}/src)
add_library(meshoptimizer::meshoptimizer ALIAS faqem_meshoptimizer)
