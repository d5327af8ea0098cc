# The libraries that faqem needs. Used by its own build and by the installed package.
# No include_guard: a second find_package(faqem) with more components must evaluate this file again.

# Components that a component links to.
set(faqem_needs_openmesh faqem)
set(faqem_needs_header_only core)
set(faqem_needs_openmesh_header_only header_only core)
set(faqem_needs_asset faqem)
set(faqem_needs_bake asset faqem)

# Libraries that users of a component need. The component c needs none: its dependencies are linked into it.
set(faqem_libraries_core Eigen)
set(faqem_libraries_faqem Threads)
set(faqem_libraries_header_only Threads)
set(faqem_libraries_openmesh OpenMesh)
set(faqem_libraries_openmesh_header_only OpenMesh)
set(faqem_libraries_asset Threads OpenImageIO tinygltf)  # and faqem_decoders, those it was built with
set(faqem_libraries_bake "")

# For each library: its CMake package, its target, and its Debian package. OpenImageIO and tinygltf are searched for by
# their header and library instead of their CMake packages: Debian's OpenImageIO package requires programs of another
# Debian package and lists include directories that are not installed, and the target of tinygltf has two names.
set(faqem_find_Threads Threads)
set(faqem_target_Threads Threads::Threads)
set(faqem_debian_Threads libc6-dev)
set(faqem_find_Eigen Eigen3 3.3 CONFIG)
set(faqem_target_Eigen Eigen3::Eigen)
set(faqem_debian_Eigen libeigen3-dev)
set(faqem_find_OpenMesh OpenMesh CONFIG)  # no version: Debian's package has no version file
set(faqem_target_OpenMesh OpenMeshCore)
set(faqem_debian_OpenMesh libopenmesh-dev)
set(faqem_find_Draco draco CONFIG)
set(faqem_target_Draco draco::draco)
set(faqem_debian_Draco libdraco-dev)
set(faqem_find_meshoptimizer meshoptimizer CONFIG)
set(faqem_target_meshoptimizer meshoptimizer::meshoptimizer)
set(faqem_debian_meshoptimizer libmeshoptimizer-dev)
set(faqem_find_nlohmann_json nlohmann_json 3.9 CONFIG)
set(faqem_target_nlohmann_json nlohmann_json::nlohmann_json)
set(faqem_debian_nlohmann_json nlohmann-json3-dev)
set(faqem_find_CLI11 CLI11 2.0 CONFIG)
set(faqem_target_CLI11 CLI11::CLI11)
set(faqem_debian_CLI11 libcli11-dev)
set(faqem_target_OpenImageIO faqem::openimageio)
set(faqem_debian_OpenImageIO libopenimageio-dev)
set(faqem_target_tinygltf faqem::tinygltf)
set(faqem_debian_tinygltf libtinygltf-dev)

# Targets that the project that uses faqem has already found are used, for example static libraries.
function(faqem_find_openimageio problem)
    if(TARGET OpenImageIO::OpenImageIO)
        add_library(faqem::openimageio INTERFACE IMPORTED)
        target_link_libraries(faqem::openimageio INTERFACE OpenImageIO::OpenImageIO)
        return()
    endif()
    find_path(FAQEM_OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h)
    find_library(FAQEM_OPENIMAGEIO_LIBRARY OpenImageIO)
    find_library(FAQEM_OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util)
    mark_as_advanced(FAQEM_OPENIMAGEIO_INCLUDE_DIR FAQEM_OPENIMAGEIO_LIBRARY FAQEM_OPENIMAGEIO_UTIL_LIBRARY)
    if(NOT FAQEM_OPENIMAGEIO_INCLUDE_DIR OR NOT FAQEM_OPENIMAGEIO_LIBRARY OR NOT FAQEM_OPENIMAGEIO_UTIL_LIBRARY)
        return()
    endif()
    file(STRINGS "${FAQEM_OPENIMAGEIO_INCLUDE_DIR}/OpenImageIO/oiioversion.h" lines
         REGEX "^#define OIIO_VERSION_(MAJOR|MINOR) +[0-9]+")
    string(REGEX REPLACE "[^0-9;]" "" numbers "${lines}")
    string(REPLACE ";" "." version "${numbers}")
    if(version VERSION_LESS 2.4)
        set(${problem} "2.4 or newer is needed, ${FAQEM_OPENIMAGEIO_INCLUDE_DIR} has ${version}" PARENT_SCOPE)
        return()
    endif()
    add_library(faqem::openimageio UNKNOWN IMPORTED)
    set_target_properties(faqem::openimageio PROPERTIES
                          IMPORTED_LOCATION "${FAQEM_OPENIMAGEIO_LIBRARY}"
                          INTERFACE_INCLUDE_DIRECTORIES "${FAQEM_OPENIMAGEIO_INCLUDE_DIR}"
                          INTERFACE_LINK_LIBRARIES "${FAQEM_OPENIMAGEIO_UTIL_LIBRARY}")
endfunction()

function(faqem_find_tinygltf)
    foreach(target IN ITEMS tinygltf::tinygltf TinyGLTF::TinyGLTF)
        if(TARGET ${target})
            add_library(faqem::tinygltf INTERFACE IMPORTED)
            target_link_libraries(faqem::tinygltf INTERFACE ${target})
            return()
        endif()
    endforeach()
    find_path(FAQEM_TINYGLTF_INCLUDE_DIR tiny_gltf.h)
    find_library(FAQEM_TINYGLTF_LIBRARY tinygltf)
    mark_as_advanced(FAQEM_TINYGLTF_INCLUDE_DIR FAQEM_TINYGLTF_LIBRARY)
    if(FAQEM_TINYGLTF_INCLUDE_DIR AND FAQEM_TINYGLTF_LIBRARY)
        add_library(faqem::tinygltf UNKNOWN IMPORTED)
        set_target_properties(faqem::tinygltf PROPERTIES
                              IMPORTED_LOCATION "${FAQEM_TINYGLTF_LIBRARY}"
                              INTERFACE_INCLUDE_DIRECTORIES "${FAQEM_TINYGLTF_INCLUDE_DIR}")
    endif()
endfunction()

# faqem_find_libraries(MISSING LIBRARY...) creates the targets of the libraries. MISSING becomes a message that names
# the libraries that are missing or too old and their Debian packages, or "" if there are none.
function(faqem_find_libraries missing)
    set(sentences "")
    set(packages "")
    foreach(library IN LISTS ARGN)
        set(problem "")
        if(TARGET ${faqem_target_${library}})
            continue()
        elseif(library STREQUAL "OpenImageIO")
            faqem_find_openimageio(problem)
        elseif(library STREQUAL "tinygltf")
            faqem_find_tinygltf()
        else()
            list(GET faqem_find_${library} 0 package)
            find_package(${faqem_find_${library}} QUIET)
            if(${package}_CONSIDERED_VERSIONS AND NOT ${package}_FOUND)
                list(GET faqem_find_${library} 1 version)
                list(JOIN ${package}_CONSIDERED_VERSIONS ", " versions)
                set(problem "${version} or newer is needed, version ${versions} was found")
            endif()
        endif()
        if(NOT TARGET ${faqem_target_${library}})
            if(problem STREQUAL "")
                set(problem "not found")
            endif()
            string(APPEND sentences "\n  ${library}: ${problem} (Debian package ${faqem_debian_${library}})")
            list(APPEND packages ${faqem_debian_${library}})
        endif()
    endforeach()
    set(message "")
    if(packages)
        list(JOIN packages " " packages)
        set(message "faqem needs these libraries:${sentences}\nOn Debian: sudo apt-get install ${packages}\nElsewhere: add the folders that contain them to CMAKE_PREFIX_PATH.")
    endif()

    # Debian's Draco library exports symbols of another tinygltf with another memory layout. Making Draco a dependency
    # of tinygltf puts tinygltf first on every link line, so that its symbols are used. Draco must be the shared library:
    # the members of its static archive would be linked before any shared library.
    if(TARGET draco::draco AND TARGET faqem::tinygltf)
        get_target_property(linked faqem::tinygltf INTERFACE_LINK_LIBRARIES)
        if(NOT "draco::draco" IN_LIST linked)
            target_link_libraries(faqem::tinygltf INTERFACE draco::draco)
        endif()
    endif()
    set(${missing} "${message}" PARENT_SCOPE)
endfunction()
