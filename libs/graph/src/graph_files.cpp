// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graph/graph_files.h"

#include "fild/core/whole_file.h"
#include "information.h"
#include "number_text.h"

#include <Eigen/LU>
#include <array>

namespace fild
{
namespace
{
using mrpt::poses::CPose3D;

std::string begin_vertex(const char* key, const GraphNode& node)
{
    return key + (" " + std::to_string(to_index(node.frame)));
}

std::string begin_edge(const char* key, const GraphEdge& edge)
{
    return key + (" " + std::to_string(to_index(edge.a))) + " " + std::to_string(to_index(edge.b));
}

void append_all(std::string& line, std::initializer_list<double> numbers)
{
    for (const double number : numbers) append_number(line, number);
}

/** The upper triangle, row by row. */
template <class Matrix>
void append_triangle(std::string& line, const Matrix& matrix)
{
    for (int row = 0; row < matrix.rows(); ++row)
        for (int column = row; column < matrix.cols(); ++column)
            append_number(line, matrix(row, column));
}

void append_toro_pose(std::string& line, const CPose3D& pose)
{
    append_all(line, {pose.x(), pose.y(), pose.z(), pose.roll(), pose.pitch(), pose.yaw()});
}

/** Rows and columns in TORO's order: x y z roll pitch yaw. */
Matrix6 in_toro_order(const Matrix6& matrix)
{
    const std::array<int, 6> order{0, 1, 2, 5, 4, 3};
    Matrix6 result;
    for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 6; ++column)
            result(row, column) = matrix(order.at(static_cast<std::size_t>(row)),
                                         order.at(static_cast<std::size_t>(column)));
    return result;
}

/** Information about (x, y, yaw) when nothing is known of the rest. */
Eigen::Matrix3d planar_information(const Matrix6& information)
{
    const Matrix6 covariance = information.inverse();
    const std::array<int, 3> place{0, 1, 3};
    Eigen::Matrix3d planar;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            planar(row, column) = covariance(place.at(static_cast<std::size_t>(row)),
                                             place.at(static_cast<std::size_t>(column)));
    const Eigen::Matrix3d inverse = planar.inverse();
    return (inverse + inverse.transpose()) / 2;
}

std::string spatial_vertex(const GraphNode& node)
{
    auto line = begin_vertex("VERTEX3", node);
    append_toro_pose(line, node.map_from_robot);
    return line;
}

std::string spatial_edge(const GraphEdge& edge)
{
    auto line = begin_edge("EDGE3", edge);
    append_toro_pose(line, edge.a_from_b);
    append_triangle(line, in_toro_order(to_eigen(edge.information)));
    return line;
}

std::string planar_vertex(const GraphNode& node)
{
    auto line = begin_vertex("VERTEX_SE2", node);
    const auto& pose = node.map_from_robot;
    append_all(line, {pose.x(), pose.y(), pose.yaw()});
    return line;
}

std::string planar_edge(const GraphEdge& edge)
{
    auto line = begin_edge("EDGE_SE2", edge);
    append_all(line, {edge.a_from_b.x(), edge.a_from_b.y(), edge.a_from_b.yaw()});
    append_triangle(line, planar_information(to_eigen(edge.information)));
    return line;
}

void append_quaternion_pose(std::string& line, const CPose3D& pose)
{
    const Rigid rigid = to_rigid(pose);
    Eigen::Quaterniond turn(rigid.rotation);
    if (turn.w() < 0) turn.coeffs() = -turn.coeffs();
    const auto& t = rigid.translation;
    append_all(line, {t.x(), t.y(), t.z(), turn.x(), turn.y(), turn.z(), turn.w()});
}

std::string g2o_vertex(const GraphNode& node)
{
    auto line = begin_vertex("VERTEX_SE3:QUAT", node);
    append_quaternion_pose(line, node.map_from_robot);
    return line;
}

std::string g2o_edge(const GraphEdge& edge)
{
    auto line = begin_edge("EDGE_SE3:QUAT", edge);
    append_quaternion_pose(line, edge.a_from_b);
    Vector6 tangent_by_g2o;  // the rotation vector is twice the quaternion's vector part
    tangent_by_g2o << 1, 1, 1, 2, 2, 2;
    const Matrix6 information = tangent_by_g2o.asDiagonal() *
                                information_in_tangent(edge.a_from_b, edge.information, "edge") *
                                tangent_by_g2o.asDiagonal();
    append_triangle(line, information);
    return line;
}

/** How a format writes its lines. */
struct GraphFormat
{
    std::string (*vertex)(const GraphNode&);
    std::string (*edge)(const GraphEdge&);
    bool fixes_first;  ///< a line FIX, which MRPT takes the root from
};

void write_graph(const std::string& path, const PoseGraph& graph, const GraphFormat& format)
{
    graph.check();
    WholeFile file(path);
    auto& stream = file.stream();
    for (const auto& node : graph.nodes) stream << format.vertex(node) << '\n';
    if (format.fixes_first && !graph.nodes.empty())
        stream << "FIX " << to_index(graph.nodes.front().frame) << '\n';
    for (const auto* edges : {&graph.odometry, &graph.loops})
        for (const auto& edge : *edges) stream << format.edge(edge) << '\n';
    file.commit();
}
}  // namespace

void write_mrpt_graph(const std::string& path, const PoseGraph& graph, GraphDimensions dimensions)
{
    const bool is_planar = dimensions == GraphDimensions::planar;
    write_graph(path,
                graph,
                is_planar ? GraphFormat{planar_vertex, planar_edge, true}
                          : GraphFormat{spatial_vertex, spatial_edge, true});
}

void write_g2o(const std::string& path, const PoseGraph& graph)
{
    write_graph(path, graph, {g2o_vertex, g2o_edge, false});
}

}  // namespace fild
