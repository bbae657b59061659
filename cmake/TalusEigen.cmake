# Eigen, installed or just unpacked: target Eigen3::Eigen.

find_package(Eigen3 3.3 QUIET NO_MODULE)
if(NOT TARGET Eigen3::Eigen)
  find_path(TALUS_EIGEN_DIR Eigen/Core HINTS "${EIGEN3_ROOT}" "$ENV{EIGEN3_ROOT}"
    PATH_SUFFIXES include/eigen3 eigen3 include)
  if(NOT TALUS_EIGEN_DIR)
    message(FATAL_ERROR "talus: Eigen 3.3 or newer is missing. Install it (Debian: libeigen3-dev, RHEL: eigen3-devel), or unpack "
      "its source anywhere and set the environment variable EIGEN3_ROOT to that folder.")
  endif()
  add_library(Eigen3::Eigen INTERFACE IMPORTED)
  target_include_directories(Eigen3::Eigen SYSTEM INTERFACE "${TALUS_EIGEN_DIR}")
endif()
