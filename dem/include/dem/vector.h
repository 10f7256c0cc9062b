#pragma once

#include <Eigen/Dense>

namespace dem
{
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;
} // namespace dem
