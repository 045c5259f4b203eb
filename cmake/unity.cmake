# SPDX-License-Identifier: Apache-2.0
# Many source files in one translation unit compile in a fifth of the time. Names in anonymous namespaces are therefore
# unique in a library. -DCMAKE_UNITY_BUILD=OFF compiles the files one by one.
if(NOT DEFINED CMAKE_UNITY_BUILD)
  set(CMAKE_UNITY_BUILD ON)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 24)
endif()
