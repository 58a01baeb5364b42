# SPDX-License-Identifier: BSD-3-Clause
# Finds OpenFOAM's headers and libraries and defines one target, OpenFOAM::finiteVolume.
#
#   a sourced environment       FOAM_SRC, FOAM_LIBBIN (openfoam.com, v1912 to v2406)
#   Debian's or Ubuntu's        /usr/lib, with headers that cfd-client/openfoam/fetch-headers.sh has put into
#   package openfoam            GIMDEM_OPENFOAM_HEADERS
#
# Nothing is downloaded here. OpenFOAM_REASON says why it was not found, OpenFOAM_PROJECT_DIR is the folder whose etc
# holds its controlDict.
set(GIMDEM_OPENFOAM_HEADERS "${CMAKE_SOURCE_DIR}/build/openfoam-headers"
  CACHE PATH "Headers for the distribution's OpenFOAM, made by cfd-client/openfoam/fetch-headers.sh")

set(OpenFOAM_FOUND FALSE)
set(OpenFOAM_flags)
if(DEFINED ENV{FOAM_SRC} AND DEFINED ENV{FOAM_LIBBIN})
  set(OpenFOAM_src $ENV{FOAM_SRC})
  set(OpenFOAM_libraries_in $ENV{FOAM_LIBBIN} $ENV{FOAM_LIBBIN}/$ENV{FOAM_MPI})
  set(OpenFOAM_PROJECT_DIR $ENV{WM_PROJECT_DIR})
  set(OpenFOAM_flags WM_$ENV{WM_PRECISION_OPTION} WM_LABEL_SIZE=$ENV{WM_LABEL_SIZE})
else()
  set(OpenFOAM_src ${GIMDEM_OPENFOAM_HEADERS}/src)
  set(OpenFOAM_libraries_in /usr/lib)
  set(OpenFOAM_PROJECT_DIR /usr/share/openfoam)
  set(OpenFOAM_flags WM_DP WM_LABEL_SIZE=32)
endif()

set(OpenFOAM_api_file ${OpenFOAM_src}/../META-INFO/api-info)
if(NOT EXISTS ${OpenFOAM_api_file})
  set(OpenFOAM_REASON "no headers in ${OpenFOAM_src}; run cfd-client/openfoam/fetch-headers.sh")
else()
  file(STRINGS ${OpenFOAM_api_file} OpenFOAM_api REGEX "^api=")
  string(REPLACE "api=" "" OpenFOAM_VERSION "${OpenFOAM_api}")

  set(OpenFOAM_libraries)
  foreach(library finiteVolume meshTools surfMesh fileFormats OpenFOAM Pstream)
    find_library(OpenFOAM_${library}_LIBRARY ${library} PATHS ${OpenFOAM_libraries_in} NO_DEFAULT_PATH)
    mark_as_advanced(OpenFOAM_${library}_LIBRARY)
    if(OpenFOAM_${library}_LIBRARY)
      list(APPEND OpenFOAM_libraries ${OpenFOAM_${library}_LIBRARY})
    elseif(NOT OpenFOAM_REASON)
      set(OpenFOAM_REASON "no lib${library}.so in ${OpenFOAM_libraries_in}; apt-get install openfoam")
    endif()
  endforeach()

  if(NOT OpenFOAM_REASON)
    set(OpenFOAM_FOUND TRUE)
    add_library(OpenFOAM::finiteVolume INTERFACE IMPORTED)
    foreach(library finiteVolume meshTools surfMesh fileFormats OpenFOAM OSspecific/POSIX)
      target_include_directories(OpenFOAM::finiteVolume SYSTEM INTERFACE ${OpenFOAM_src}/${library}/lnInclude)
    endforeach()
    # linux64 and WM_ARCH_OPTION only name the platform; NoRepository makes headers include their template definitions.
    target_compile_definitions(OpenFOAM::finiteVolume INTERFACE
      linux64 WM_ARCH_OPTION=64 NoRepository OPENFOAM=${OpenFOAM_VERSION} ${OpenFOAM_flags})
    target_compile_options(OpenFOAM::finiteVolume INTERFACE -ftemplate-depth-100)
    # Libraries register their boundary conditions and schemes as they load, so all must be loaded.
    target_link_libraries(OpenFOAM::finiteVolume INTERFACE
      -Wl,--push-state,--no-as-needed ${OpenFOAM_libraries} -Wl,--pop-state)
  endif()
endif()

if(NOT OpenFOAM_FOUND AND OpenFOAM_FIND_REQUIRED)
  message(FATAL_ERROR "OpenFOAM: ${OpenFOAM_REASON}")
endif()
