#include "joint_json.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

Json batch_json(const JointRelaxation::Batch& batch) {
  return {{"items", batch.items},
          {"decided", batch.decided},
          {"begins", batch.begins},
          {"ends", batch.ends},
          {"most", batch.most},
          {"before", batch.before},
          {"takes", batch.takes},
          {"after", batch.after},
          {"loaded_by", batch.loaded_by},
          {"full", batch.full},
          {"some", batch.some},
          {"before_decision", batch.before_decision},
          {"before_next_decision", batch.before_next_decision}};
}

Json resource_json(const JointRelaxation::Resource& resource) {
  Json jobs = Json::array();
  for (const JointRelaxation::Job& job : resource.jobs)
    jobs.push_back({job.take, job.begin, job.anchor, job.free, job.hold, job.type, job.number});
  Json work = Json::array();
  for (const JointRelaxation::Work& one : resource.work)
    work.push_back({one.base, one.each, one.batch});
  Json instants = Json::array();
  for (const JointRelaxation::Instant& one : resource.instants)
    instants.push_back({one.node, one.before});
  return {{"name", resource.name},
          {"capacity", resource.capacity},
          {"jobs", jobs},
          {"recovery", resource.recovery},
          {"lag", resource.lag},
          {"way", resource.way},
          {"first_way", resource.first_way},
          {"work", work},
          {"instants", instants},
          {"exclusive", resource.exclusive}};
}

}  // namespace

Json to_json(const JointRelaxation& relaxation) {
  Json json{
      {"limit", relaxation.limit}, {"least_end", relaxation.least_end}, {"ends", relaxation.ends}};
  Json& nodes = json["nodes"] = Json::array();
  for (const auto& node : relaxation.nodes) nodes.push_back({node.least, node.needed, node.name});
  Json& precedences = json["precedences"] = Json::array();
  for (const auto& one : relaxation.precedences) precedences.push_back({one.from, one.to, one.lag});
  Json& eithers = json["eithers"] = Json::array();
  for (const auto& either : relaxation.eithers)
    eithers.push_back({{"node", either.node}, {"options", either.options}});
  Json& batches = json["batches"] = Json::array();
  for (const auto& batch : relaxation.batches) batches.push_back(batch_json(batch));
  Json& resources = json["resources"] = Json::array();
  for (const auto& resource : relaxation.resources) resources.push_back(resource_json(resource));
  return json;
}

}  // namespace linewright::cli
