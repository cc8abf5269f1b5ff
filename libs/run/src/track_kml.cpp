// SPDX-License-Identifier: BSD-3-Clause
#include "track_kml.h"

#include "fild/core/number_text.h"
#include "fild/core/whole_file.h"

#include <map>
#include <vector>

namespace fild
{
namespace
{
/** How a line is drawn. */
struct Style
{
    std::string id;
    std::string colour;  ///< aabbggrr
};

std::string degrees(double value)
{
    constexpr int kDigits = 9;  // 0.1 mm
    return decimal(value, kDigits);
}

std::string line_through(const std::vector<mrpt::poses::CPose3D>& poses, const EastNorthUp& plane)
{
    std::string line = "<LineString><tessellate>1</tessellate><coordinates>";
    for (const auto& pose : poses)
    {
        const auto place = plane.place_of({pose.x(), pose.y(), pose.z()});
        line += degrees(place.longitude_deg) + "," + degrees(place.latitude_deg) + "\n";
    }
    return line + "</coordinates></LineString>\n";
}

/** A line for each segment: between two the motion is unknown. */
std::string lines_of(const std::vector<TrajectoryPose>& way, const EastNorthUp& plane)
{
    std::map<int, std::vector<mrpt::poses::CPose3D>> segments;
    for (const auto& pose : way) segments[pose.segment].push_back(pose.map_from_robot);
    std::string lines;
    for (const auto& [segment, poses] : segments) lines += line_through(poses, plane);
    return lines;
}

std::string lines_of_loops(const Map& map, const EastNorthUp& plane)
{
    std::map<FrameId, mrpt::poses::CPose3D> pose_of;
    for (const auto& node : map.graph.nodes) pose_of[node.frame] = node.map_from_robot;
    std::string lines;
    for (const auto& loop : map.graph.loops)
        lines += line_through({pose_of.at(loop.a), pose_of.at(loop.b)}, plane);
    return lines;
}

std::string placemark(const std::string& name, const Style& style, const std::string& lines)
{
    return "<Placemark><name>" + name + "</name><styleUrl>#" + style.id +
           "</styleUrl><MultiGeometry>\n" + lines + "</MultiGeometry></Placemark>\n";
}
}  // namespace

void write_track_kml(const Map& map, const std::string& path)
{
    const EastNorthUp plane(map.origin.value());
    const Style before{"before", "ff888888"};
    const Style after{"after", "ffff7800"};
    const Style loop{"loop", "ff00c800"};
    WholeFile file(path);
    auto& out = file.stream();
    out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<kml xmlns=\"http://www.opengis.net/kml/2.2\"><Document><name>mrpt-fild</name>\n";
    for (const auto& style : {before, after, loop})
        out << "<Style id=\"" << style.id << "\"><LineStyle><color>" << style.colour
            << "</color><width>3</width></LineStyle></Style>\n";
    out << placemark("before the loops", before, lines_of(map.trajectory.poses(), plane))
        << placemark("after the loops", after, lines_of(map.optimized, plane))
        << placemark("loops", loop, lines_of_loops(map, plane)) << "</Document></kml>\n";
    file.commit();
}

}  // namespace fild
