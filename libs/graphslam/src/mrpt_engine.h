// SPDX-License-Identifier: BSD-3-Clause
// MRPT's graph-SLAM engine, whose headers need others before them that they do not include.
#pragma once

// clang-format off
#include <mrpt/opengl/CDisk.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/CPointCloud.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSphere.h>
#include <mrpt/opengl/stock_objects.h>

#include <mrpt/graphslam/CGraphSlamEngine.h>
#include <mrpt/graphslam/CGraphSlamEngine_impl.h>
#include <mrpt/graphslam/ERD/CEmptyERD.h>
#include <mrpt/graphslam/GSO/CLevMarqGSO.h>
// clang-format on
