# What the program needs besides its libraries.
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS EGL OpenGL)
