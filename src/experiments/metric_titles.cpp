#include "metric_titles.hpp"

namespace linewright::experiments {

const char* title_of(Metric metric) {
  switch (metric) {
    case Metric::kMakespan:
      return "Makespan, ticks";
    case Metric::kSuccessRate:
      return "Success rate (share of runs that finish the order)";
    case Metric::kProgress:
      return "Mean progress (share of the order that is finished)";
    case Metric::kDistance:
      return "Distance, metres, all workers together";
    case Metric::kDecisions:
      return "Decisions (tasks that were started)";
    case Metric::kTraining:
      return "Training";
  }
  return "";
}

const char* short_title_of(Metric metric) {
  switch (metric) {
    case Metric::kMakespan:
      return "Makespan, ticks";
    case Metric::kSuccessRate:
      return "Success rate";
    case Metric::kProgress:
      return "Mean progress";
    case Metric::kDistance:
      return "Distance, m";
    case Metric::kDecisions:
      return "Decisions";
    case Metric::kTraining:
      return "Training";
  }
  return "";
}

const char* word_of(Metric metric) {
  switch (metric) {
    case Metric::kMakespan:
      return "makespan";
    case Metric::kSuccessRate:
      return "success";
    case Metric::kProgress:
      return "progress";
    case Metric::kDistance:
      return "distance";
    case Metric::kDecisions:
      return "decisions";
    case Metric::kTraining:
      return "training";
  }
  return "";
}

}  // namespace linewright::experiments
