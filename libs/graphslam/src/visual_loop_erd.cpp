// SPDX-License-Identifier: BSD-3-Clause
#include "fild/graphslam/visual_loop_erd.h"

#include "constraint.h"
#include "fild/graphslam/decider_options.h"

#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace fild
{
namespace
{
constexpr const char* kSection = "EdgeRegistrationDeciderParameters";

/** The time of an entry of a rawlog: that of the observation, or of the first of a sensory frame
 *  that has one. */
std::optional<double> time_of(const mrpt::obs::CSensoryFrame::Ptr& observations,
                              const mrpt::obs::CObservation::Ptr& observation)
{
    const auto has_time = [](const mrpt::obs::CObservation::Ptr& each)
    { return each && each->timestamp != INVALID_TIMESTAMP; };
    if (has_time(observation)) return mrpt::Clock::toDouble(observation->timestamp);
    if (observations)
        for (const auto& each : *observations)
            if (has_time(each)) return mrpt::Clock::toDouble(each->timestamp);
    return std::nullopt;
}
}  // namespace

template <class GRAPH_T>
CVisualLoopERD<GRAPH_T>::CVisualLoopERD(const std::string& rawlog_path) : rawlog_path_(rawlog_path)
{
    this->setClassName("CVisualLoopERD");
}

template <class GRAPH_T>
void CVisualLoopERD<GRAPH_T>::loadParams(const std::string& source_fname)
{
    const auto options = load_decider_options(source_fname, kSection);
    this->setMinLoggingLevel(options.verbosity);
    loops_ = std::make_unique<NodeLoops>(options.stream, options.graph, rawlog_path_);
}

template <class GRAPH_T>
void CVisualLoopERD<GRAPH_T>::printParams() const
{
    std::string text;
    getDescriptiveReport(&text);
    std::cout << "[" << kSection << "]\n" << text;
}

template <class GRAPH_T>
void CVisualLoopERD<GRAPH_T>::getDescriptiveReport(std::string* report_str) const
{
    std::ostringstream text;
    text << "Edge registration by visual loop closures: " << registered_ << " edges";
    if (loops_)
    {
        text << " of " << report().loop_closures << " loop closures, " << report().camera_frames
             << " camera frames";
        for (const auto& [reason, count] : report().withheld)
            text << "; " << reason << ": " << count;
    }
    *report_str += text.str() + "\n";
}

template <class GRAPH_T>
void CVisualLoopERD<GRAPH_T>::getEdgesStats(std::map<std::string, int>* edge_type_to_num) const
{
    (*edge_type_to_num)["lc"] = static_cast<int>(registered_);
}

template <class GRAPH_T>
bool CVisualLoopERD<GRAPH_T>::updateState(mrpt::obs::CActionCollection::Ptr action,
                                          mrpt::obs::CSensoryFrame::Ptr observations,
                                          mrpt::obs::CObservation::Ptr observation)
{
    if (!loops_) throw std::logic_error("CVisualLoopERD::updateState() before loadParams()");
    if (action) loops_->feed(*action);
    note_new_node(observations, observation);
    if (observations)
        for (const auto& each : *observations) loops_->feed(*each);
    if (observation) loops_->feed(*observation);
    add_edges(loops_->take_settled());
    return true;
}

template <class GRAPH_T>
void CVisualLoopERD<GRAPH_T>::note_new_node(const mrpt::obs::CSensoryFrame::Ptr& observations,
                                            const mrpt::obs::CObservation::Ptr& observation)
{
    const auto nodes = this->m_graph->nodeCount();
    if (nodes == known_nodes_) return;
    known_nodes_ = nodes;
    if (const auto time = time_of(observations, observation))
        loops_->add_node(NodeId{this->m_graph->nodes.rbegin()->first}, *time);
}

template <class GRAPH_T>
void CVisualLoopERD<GRAPH_T>::finish()
{
    if (!loops_) throw std::logic_error("CVisualLoopERD::finish() before loadParams()");
    add_edges(loops_->take_all());
}

template <class GRAPH_T>
void CVisualLoopERD<GRAPH_T>::add_edges(const std::vector<NodeLoop>& loops)
{
    this->m_just_inserted_lc = !loops.empty();
    for (const auto& loop : loops)
    {
        constraint_t constraint;
        set_constraint(loop.motion, constraint);
        registerNewEdge(static_cast<mrpt::graphs::TNodeID>(loop.candidate_node),
                        static_cast<mrpt::graphs::TNodeID>(loop.query_node),
                        constraint);
        MRPT_LOG_INFO_STREAM("loop closure of frame "
                             << to_index(loop.query) << " with frame " << to_index(loop.candidate)
                             << ": edge between nodes "
                             << static_cast<mrpt::graphs::TNodeID>(loop.candidate_node) << " and "
                             << static_cast<mrpt::graphs::TNodeID>(loop.query_node));
    }
}

template <class GRAPH_T>
void CVisualLoopERD<GRAPH_T>::registerNewEdge(const mrpt::graphs::TNodeID& from,
                                              const mrpt::graphs::TNodeID& to,
                                              const constraint_t& rel_edge)
{
    parent_t::registerNewEdge(from, to, rel_edge);
    this->m_graph->insertEdge(from, to, rel_edge);
    ++registered_;
}

template class CVisualLoopERD<mrpt::graphs::CNetworkOfPoses2DInf>;
template class CVisualLoopERD<mrpt::graphs::CNetworkOfPoses3DInf>;

}  // namespace fild
