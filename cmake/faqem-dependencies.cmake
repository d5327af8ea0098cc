# Dependencies of faqem, used by its own build and by the installed package.
# No include_guard: a second find_package(faqem) with more components must evaluate this file again.
#
# faqem_find_dependencies(COMPONENT...) finds the dependencies of components:
#   core                  engine templates                  Eigen
#   faqem                 compiled presets                  threads (Eigen while building)
#   header_only           presets as headers                Eigen, threads
#   openmesh              OpenMesh entry point              OpenMesh
#   openmesh_header_only  OpenMesh entry point as headers   OpenMesh, Eigen, threads
#   asset                 reading and writing of files      tinygltf and OpenImageIO, not in the headers; Draco and
#                                                           meshoptimizer if FAQEM_HAS_DRACO, FAQEM_HAS_MESHOPT
#   bake                  baker                             as asset
#   c                     C interface                       nothing: its dependencies are linked into it

# Components that a component links to.
set(faqem_needs_openmesh faqem)
set(faqem_needs_header_only core)
set(faqem_needs_openmesh_header_only header_only core)
set(faqem_needs_asset faqem)
set(faqem_needs_bake asset faqem)

# Debian 12 exports TinyGLTF::TinyGLTF, upstream exports tinygltf::tinygltf. The upstream name is used here.
macro(faqem_find_tinygltf)
    if(NOT TARGET tinygltf::tinygltf)
        find_package(TinyGLTF CONFIG QUIET)
        if(TARGET TinyGLTF::TinyGLTF)
            add_library(tinygltf::tinygltf INTERFACE IMPORTED)
            target_link_libraries(tinygltf::tinygltf INTERFACE TinyGLTF::TinyGLTF)
        else()
            find_package(tinygltf CONFIG REQUIRED)
        endif()
    endif()
endmacro()

# The OpenImageIO target of Debian 12 lists include directories that its packages do not install.
macro(faqem_find_openimageio)
    if(NOT TARGET OpenImageIO::OpenImageIO)
        # Imath, which it brings in, reports each file of its Python package that is not installed.
        set(faqem_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
        set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
        find_package(OpenImageIO CONFIG REQUIRED)
        set(CMAKE_MESSAGE_LOG_LEVEL "${faqem_log_level}")
        foreach(faqem_target IN ITEMS OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
            get_target_property(faqem_dirs ${faqem_target} INTERFACE_INCLUDE_DIRECTORIES)
            set(faqem_existing "")
            foreach(faqem_dir IN LISTS faqem_dirs)
                if(EXISTS "${faqem_dir}")
                    list(APPEND faqem_existing "${faqem_dir}")
                endif()
            endforeach()
            set_target_properties(${faqem_target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${faqem_existing}")
        endforeach()
    endif()
endmacro()

# Debian's Draco library exports symbols of another tinygltf with another memory layout. Making Draco a
# dependency of tinygltf puts tinygltf first on every link line, so that its symbols are used. Draco must be
# the shared library: the members of its static archive would be linked before any shared library.
macro(faqem_find_draco)
    find_package(draco CONFIG REQUIRED)
    set_property(TARGET tinygltf::tinygltf APPEND PROPERTY INTERFACE_LINK_LIBRARIES draco::draco)
endmacro()

macro(faqem_find_dependencies)
    foreach(faqem_component IN ITEMS ${ARGN})
        if(faqem_component STREQUAL "core")
            find_package(Eigen3 3.3 CONFIG REQUIRED)
        elseif(faqem_component STREQUAL "faqem" OR faqem_component STREQUAL "header_only")
            find_package(Threads REQUIRED)
        elseif(faqem_component STREQUAL "openmesh" OR faqem_component STREQUAL "openmesh_header_only")
            find_package(OpenMesh CONFIG REQUIRED)  # no version: Debian's package has no version file
        elseif(faqem_component STREQUAL "asset" OR faqem_component STREQUAL "bake")
            find_package(Threads REQUIRED)
            faqem_find_openimageio()
            faqem_find_tinygltf()
            if(FAQEM_HAS_DRACO)
                faqem_find_draco()
            endif()
            if(FAQEM_HAS_MESHOPT)
                find_package(meshoptimizer CONFIG REQUIRED)
            endif()
        elseif(NOT faqem_component STREQUAL "c")
            message(FATAL_ERROR "unknown component of faqem: ${faqem_component}")
        endif()
    endforeach()
endmacro()
