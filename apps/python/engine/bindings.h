#pragma once

#include <dem/parameters/engine.h>

#include <pybind11/pybind11.h>
#include <string>

/// Parts of the Python module of the engine, one function each.
void bind_parameters(pybind11::module_ &module);
void bind_engine(pybind11::module_ &module);

/// Throw std::invalid_argument with name, value and what is allowed.
void check_parameters(const dem::EngineParameters &parameters);
void require_finite(const std::string &name, const dem::Vec3 &value);
void require_length(const std::string &name, double value);
