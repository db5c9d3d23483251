#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "linewright/evaluation/log_document.hpp"

// A short event log, written by hand, for the tests of whatever reads or draws logs.
namespace linewright::test {

inline const std::vector<std::string>& small_log_lines() {
  static const std::vector<std::string> kLines = {
      R"({"format":"linewright/event_log/1","line":"little_line","scenario_hash":"00112233445566ff","tick_s":0.5,"horizon":100,"order":{"product":"box","quantity":2,"finished_in":"store"},"workers":[{"id":"human.0","kind":"human","start":"desk"},{"id":"robot.0","kind":"robot","start":"dock"}],"carriers":[{"id":"cage.0","kind":"cage","capacity":2,"start":"rack"}],"stations":{"desk":{"human":[1.5,2.0,0.0]},"dock":{"robot":[0,0,0]},"rack":{"human":[5,5,1.57],"robot":[5,6,1.57]}},"places":[{"name":"stock","of":"box","initial":2},{"name":"table","of":"box","initial":0,"capacity":2},{"name":"store","of":"box","initial":0},{"name":"bay","of":"box","initial":0,"berth":"cage"}],"machines":["press","clamp"],"operations":[{"name":"grip","takes":4,"claims":["clamp"],"consumes":{"table":1}},{"name":"punch","takes":6,"uses":["press"],"recovery":3},{"name":"let_go","takes":2,"frees":["clamp"],"produces":{"store":1}}],"tasks":[{"number":1,"name":"bring"},{"number":2,"name":"operate"}],"hall":{"bounds":[-1,10,-1,10],"obstacles":[{"name":"wall","polygon":[[0,9],[1,9],[1,10],[0,10]],"height":2.5}]}})",
      R"({"t":1,"event":"decision","n":1,"task":"bring","crew":{"human":["human.0"],"robot":[],"cage":["cage.0"]}})",
      R"({"t":1,"event":"go","n":1,"worker":"human.0","from":"desk","to":"rack","departs":2,"arrives":6,"metres":4.61,"path":[[1.5,2,0,0],[3,3,0.6,0.5],[5,5,0,1]]})",
      R"({"t":3,"event":"join","n":1,"worker":"robot.0","role":"robot"})",
      R"({"t":3,"event":"go","n":1,"worker":"robot.0","from":"dock","to":"rack","departs":3,"arrives":10,"metres":7.81})",
      R"({"t":10,"event":"pick_up","n":1,"worker":"robot.0","carrier":"cage.0"})",
      R"({"t":10,"event":"transfer","n":1,"worker":"human.0","from":"stock","to":"cage.0","until":13})",
      R"({"t":13,"event":"transfer","n":1,"worker":"human.0","from":"cage.0","to":"table","until":16})",
      R"({"t":16,"event":"put_down","n":1,"worker":"robot.0","carrier":"cage.0","station":"rack","berth":"bay"})",
      R"({"t":16,"event":"release","n":1,"worker":"robot.0"})",
      R"({"t":16,"event":"operation_start","operation":"grip","until":20})",
      R"({"t":18,"event":"task_end","n":1,"task":"bring"})",
      R"({"t":20,"event":"operation_end","operation":"grip"})",
      R"({"t":21,"event":"decision","n":2,"task":"operate","crew":{"human":["human.0"]}})",
      R"({"t":21,"event":"berth","n":2,"carrier":"cage.0","berth":"bay"})",
      R"({"t":22,"event":"operation_start","operation":"punch","until":28,"worker":"human.0"})",
      R"({"t":28,"event":"operation_end","operation":"punch"})",
      R"({"t":28,"event":"milestone","name":"punched"})",
      R"({"t":28,"event":"task_end","n":2,"task":"operate"})",
      R"({"t":30,"event":"operation_start","operation":"let_go","until":32})",
      R"({"t":31,"event":"recovery_end","operation":"punch"})",
      R"({"t":32,"event":"operation_end","operation":"let_go"})",
      R"({"t":32,"event":"end","status":"finished","makespan":32,"progress":1.0})",
  };
  return kLines;
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

inline std::string small_log() { return joined(small_log_lines()); }

/// The beginning of the small log with a zone: robot.0 is on its way to rest and has to take
/// another way, human.0 has none for a while.
inline std::string zones_log() {
  std::string header = small_log_lines()[0];
  header.insert(
      header.find("\"hall\""),
      R"("zones":[{"name":"gate","polygon":[[1,1],[4,1],[4,4],[1,4]],"closed":[[4,8]]}],)");
  return joined({
      header,
      R"({"t":2,"event":"go","worker":"robot.0","from":"dock","to":"rack","departs":2,"arrives":10,"metres":7.81})",
      R"({"t":3,"event":"decision","n":1,"task":"bring","crew":{"human":["human.0"],"robot":[],"cage":["cage.0"]}})",
      R"({"t":4,"event":"zone","zone":"gate","closed":true})",
      R"({"t":4,"event":"reroute","worker":"robot.0","pose":[2,0,0],"to":"rack","departs":4,"arrives":20,"metres":9.5,"path":[[2,0,0,0],[5,6,0,1]]})",
      R"({"t":5,"event":"go","n":1,"worker":"human.0","from":"desk","to":"rack","departs":5,"arrives":9,"metres":4.61})",
      R"({"t":7,"event":"blocked","worker":"human.0","pose":[3,3,0.5],"to":"rack"})",
      R"({"t":11,"event":"join","n":1,"worker":"robot.0","role":"robot"})",
      R"({"t":12,"event":"zone","zone":"gate","closed":false})",
      R"({"t":12,"event":"reroute","n":1,"worker":"human.0","pose":[3,3,0.5],"to":"rack","departs":12,"arrives":15,"metres":2.8})",
      R"({"t":18,"event":"task_end","n":1,"task":"bring"})",
      R"({"t":32,"event":"end","status":"finished","makespan":32,"progress":1.0})",
  });
}

/// The small log with every `from` written as `to`.
inline std::string small_log_with(const std::string& from, const std::string& to) {
  std::string text = small_log();
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

inline LogDocument read_text(const std::string& text) {
  std::istringstream stream(text);
  return read_event_log(stream, "run.jsonl");
}

}  // namespace linewright::test
