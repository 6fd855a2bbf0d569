// Nothing of its own: CMake makes a precompiled header of a target with a source (tests/CMakeLists.txt).
