#pragma once

#include <pybind11/pybind11.h>

/// Parts of the Python module of the engine, one function each.
void bind_parameters(pybind11::module_ &module);
void bind_engine(pybind11::module_ &module);
