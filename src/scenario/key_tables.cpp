#include <fmt/format.h>

#include <utility>

#include "limits.hpp"
#include "linewright/line/way_finder.hpp"
#include "linewright/scenario/shape_makers.hpp"
#include "scenario_shape.hpp"

namespace linewright::loading {
namespace {

using Kind = Shape::Kind;

ShapePtr section(const std::string& noun, ShapePtr entry, std::size_t most = kMostEntries) {
  return names_to(std::move(entry), fmt::format("a mapping from names to {}s", noun), noun, most);
}

ShapePtr name(const std::string& what) { return scalar(Kind::kName, what); }
ShapePtr ticks() { return integer(0, kMaxTicks); }
ShapePtr coordinate() { return real(-kLargestCoordinate, kLargestCoordinate); }

ShapePtr condition() {
  const ShapePtr one = scalar(Kind::kCondition, "a condition");
  return one_of({one, list(one, "a list of at most 100 conditions", 0, 100)});
}

ShapePtr range(std::int32_t min) {
  const ShapePtr bound = integer(min, kMostOfAKind);
  return list(bound, "[min, max]", 2, 2);
}

ShapePtr start(const std::string& of) {
  return one_of({choice({"random_station"}),
                 list(name("a station"), "a list of stations, one per " + of, 0, kMostOfAKind)});
}

ShapePtr rectangle() { return list(coordinate(), "[x0, x1, y0, y1]", 4, 4); }

ShapePtr rest() {
  return one_of({name("a station"), list(name("a station"), "a list of stations", 1)});
}

ShapePtr worker() {
  return mapping(
      "a mapping with the properties of a kind of worker",
      {key("count", one_of({integer(0, kMostOfAKind), range(0)}),
           "How many; [min, max] is drawn uniformly at reset. Default 1"),
       key("speed_mps", real(1e-3, 1e3), "Metres per second. Default 1.0"),
       key("radius_m", real(0, 100), "Radius of the circle around the worker, metres. Default 0.3"),
       key("outline_m",
           list(list(real(-100, 100), "[x_m, y_m]", 2, 2), "a list of 3 to 16 corners [x_m, y_m]",
                3, kMostOutlineCorners),
           "Instead of footprint_m: corners of a polygon around the worker, x forward, y left"),
       key("footprint_m", list(real(1e-3, 100), "[length, width]", 2, 2),
           "Length and width, metres"),
       key("turning_radius_m", real(0, 1e3), "Metres; 0 turns on the spot. Default 0"),
       key("turn_rate_radps", real(0, 1e3),
           "Radians per second, turning on the spot; 0 takes no time. Default 0"),
       key("acceleration_mps2", real(0, 1e3),
           "Metres per second squared, from and to standstill; 0: full speed at once. Default 0"),
       key("rest", rest(), "Where a worker without a task goes: the nearest of these stations"),
       key("rest_after", ticks(), "Ticks without a task before it leaves for there. Default 0"),
       key("min_leg_ticks", ticks(), "A go or fetch lasts at least this long. Default 0"),
       key("start", start("worker"), "Drawn without replacement, or a list: worker i at entry i")});
}

ShapePtr carrier() {
  return mapping(
      "a mapping with the properties of a kind of carrier",
      {key("count",
           one_of({integer(0, kMostOfAKind), range(0),
                   name("a kind of worker (as many as of these)")}),
           "How many, or the kind of worker there are as many of. Default 1"),
       key("capacity", integer(1, kLargestAmount), "Items, all of one material. Default 1"),
       required("moved_by", name("a kind of worker"), "The kind of worker that moves it"),
       key("start", start("carrier"), "As for workers, over the mover's stations")});
}

ShapePtr station() {
  Shape shape = *names_to(list(coordinate(), "[x_m, y_m, yaw_rad]", 3, 3),
                          "a mapping from kinds of workers to poses");
  shape.fields = {
      key("slots", names_to(integer(0, kMostOfAKind), "a mapping from kinds of workers to numbers"),
          "How many of a kind may start here. Default 1")};
  return make(std::move(shape));
}

ShapePtr place() {
  return mapping(
      "a mapping with the properties of a place",
      {key("of", name("a material"), "Kind of material. Default: the place's name"),
       key("capacity", integer(1, kLargestAmount), "Default: unlimited"),
       key("initial", one_of({integer(0, kLargestAmount), name("'order' or 'N*order'")}),
           "Tokens at the start: a number, `order` or `N*order`. Default 0"),
       key("at", name("a station"), "The station where it is"),
       key("carrier", name("a kind of carrier"), "Makes the place a berth for one such carrier"),
       key("occupied", choice({"on_arrival", "on_assignment"}),
           "From when a carrier counts as standing in the berth")});
}

ShapePtr corners() {
  return list(list(coordinate(), "[x, y]", 2, 2),
              fmt::format("a list of 3 to {} corners [x, y]", kMostCorners), 3, kMostCorners);
}

ShapePtr area() {
  return one_of(
      {rectangle(),
       variant("area", "a mapping {polygon: [[x, y], ...]}",
               {mapping("", {required("rectangle", rectangle(), "x0, x1, y0, y1 in metres")}),
                mapping("", {required("polygon", corners(), "Corners in order, metres")})})});
}

ShapePtr machine() {
  const ShapePtr position = name("a position");
  return mapping(
      "a mapping with the properties of a machine",
      {key("at", name("a station"), "Where it is drawn"),
       key("area_m", area(), "The floor it takes up, for pictures only"),
       key("positions", list(position, "a list of at most 64 positions", 1, kMostPositions),
           "Where the machine can stand"),
       key("start", position, "Where it stands at the start. Default: the first position"),
       key("travel",
           names_to(names_to(ticks(), "a mapping {FROM: ticks}"), "a mapping {TO: {FROM: ticks}}"),
           "Ticks from position to position: {TO: {FROM: ticks}}"),
       key("homing",
           mapping("a mapping {to: POSITION, takes: {POSITION: ticks}}",
                   {required("to", position, "Where the idle machine drives by itself"),
                    required("takes", names_to(ticks(), "a mapping {POSITION: ticks}"),
                             "Ticks to get there, by position"),
                    key("holds", ticks(),
                        "Ticks for which it stays where it came to rest. Default 0")}),
           "The machine drives home when idle")});
}

ShapePtr machine_uses() {
  const ShapePtr move = mapping("a mapping {from: POSITION, to: POSITION}",
                                {key("from", name("a position"), "Travels here first"),
                                 key("to", name("a position"), "Stands here at the end")});
  const ShapePtr moved = names_to(move, "a mapping {MACHINE: {from: POSITION, to: POSITION}}");
  return list(one_of({name("a machine"), moved}), "a list of machines");
}

ShapePtr token_flows() {
  const ShapePtr counted = names_to(integer(1, kLargestAmount), "a mapping {PLACE: count}");
  return one_of({list(one_of({name("a place"), counted}), "a list of places"), counted});
}

ShapePtr operation() {
  return mapping(
      "a mapping with the properties of an operation",
      {key("takes", ticks(),
           "Ticks from the start to the products, without machine travel. Default 0"),
       key("uses", machine_uses(), "Machines held to the end of the recovery"),
       key("claims", machine_uses(), "Machines taken and kept until an operation frees them"),
       key("frees", machine_uses(), "Machines claimed earlier, let go at the end of the recovery"),
       key("consumes", token_flows(), "Places that tokens are taken from"),
       key("produces", token_flows(), "Places that tokens are put into"),
       key("when", condition(), "Conditions that must hold at the start"),
       key("recovery", ticks(), "Ticks for which machines are held after the products are out"),
       key("operated_by", name("a kind of worker"),
           "Starts only by an operate action of such a worker")});
}

ShapePtr crew_slot() {
  return one_of(
      {integer(1, kMostCrew),
       mapping("a mapping {count: N, join: late}",
               {key("count", integer(1, kMostCrew), "How many. Default 1"),
                key("join", choice({"late", "at_start"}), "late: the task may start without")}),
       name("empty, any or a berth (for a carrier)")});
}

ShapePtr action_shape(Field what, std::vector<Field> more = {}) {
  Shape shape;
  shape.kind = Kind::kMapping;
  shape.noun = what.key;
  what.required = true;
  shape.fields = {std::move(what)};
  for (Field& field : more) shape.fields.push_back(std::move(field));
  shape.fields.push_back(key("before", ticks(), "Ticks of preparation. Default 0"));
  shape.fields.push_back(key("after", ticks(), "Ticks of settling. Default 0"));
  return make(std::move(shape));
}

ShapePtr action() {
  const ShapePtr end = name("a place or a carrier");
  return variant(
      "action", "an action such as {go: STATION}",
      {action_shape(key("go", name("a station"), "Walk or drive there with the carrier held")),
       action_shape(key("fetch", name("a carrier"), "Go to the carrier and take it along")),
       action_shape(key("park", name("a carrier"), "Put the carrier down"),
                    {key("berth", name("a berth"), "Where it stays when the task is over")}),
       action_shape(key("transfer", list(end, "[FROM, TO]", 2, 2), "Move items one by one"),
                    {key("takes", integer(1, kMaxTicks), "Ticks per item. Default 1"),
                     key("repeat", one_of({integer(1, kLargestAmount), choice({"until_blocked"})}),
                         "How many items. Default 1")}),
       action_shape(
           key("operate", name("an operation"), "Start it and stay until its products are out")),
       action_shape(key("release", choice({"true"}), "Leave the task"))});
}

ShapePtr reservations() {
  const ShapePtr one =
      one_of({name("a place"), mapping("a mapping {room: PLACE}",
                                       {required("room", name("a place"), "Room for one token")})});
  return one_of({name("a place"),
                 mapping("a mapping {room: PLACE}",
                         {required("room", name("a place"), "Room for one token")}),
                 list(one, "a list of places and {room: PLACE}")});
}

ShapePtr task() {
  const ShapePtr sequence =
      one_of({action(), list(action(), "a list of actions", 1, kMostActions)});
  return mapping(
      "a mapping with the properties of a task",
      {key("number", integer(1, kLargestAmount),
           "1-based number for planners and logs. Default: place in the file"),
       required("crew", names_to(crew_slot(), "a mapping such as {human: 1, cage: empty}"),
                "How many of each kind of worker, and which carriers"),
       key("when", condition(), "Conditions for being selectable"),
       key("reserves", reservations(),
           "A token, or room for one, kept from others from the decision on"),
       key("max_running", integer(1, kMostOfAKind), "Executions at a time. Default 1"),
       required(
           "steps",
           list(names_to(sequence, "a mapping {ROLE: actions}"), "a list of steps", 1, kMostSteps),
           "One line is one rendezvous")});
}

ShapePtr milestone() {
  const auto event = [](const char* what, const char* of, const char* about) {
    return mapping("", {required(what, name(of), about)});
  };
  return variant("event", "a mapping such as {operation: NAME}",
                 {event("operation", "an operation", "When its products appear"),
                  event("place", "a place", "When a token arrives"),
                  event("task_start", "a task", "When the task starts"),
                  event("task_end", "a task", "When the task ends")});
}

ShapePtr obstacle() {
  const Field height = key("height_m", real(1e-3, 1e3), "For pictures, metres. Default 1.0");
  return one_of(
      {rectangle(),
       variant(
           "obstacle", "a mapping {rectangle: [x0, x1, y0, y1], height_m: H}",
           {mapping("", {required("rectangle", rectangle(), "x0, x1, y0, y1 in metres"), height}),
            mapping("", {required("polygon", corners(), "Corners in order, metres"), height})})});
}

ShapePtr map() {
  return mapping(
      "a mapping with bounds or occupancy, and obstacles",
      {key("bounds", rectangle(), "x0, x1, y0, y1 in metres; this or `occupancy` is required"),
       key("cell_m", real(kSmallestCell, 100),
           "With `bounds`: edge of a grid cell, metres. Default 0.25"),
       key("occupancy", scalar(Kind::kText, "a file name"),
           "A map of ROS map_server (YAML), relative to this file"),
       key("obstacles", section("obstacle", obstacle()), "What nothing drives through")});
}

ShapePtr zone() {
  const ShapePtr corner = list(coordinate(), "[x_m, y_m]", 2, 2);
  const ShapePtr span = list(integer(1, kMaxTicks), "[tick, ticks]", 2, 2);
  return mapping(
      "a mapping with a rectangle or a polygon",
      {key("rectangle", rectangle(), "x0, x1, y0, y1 in metres"),
       key("polygon", list(corner, "a list of 3 to 200 corners [x_m, y_m]", 3, kMostCorners),
           "Its corners in order, metres"),
       key("closed", list(span, "a list of [tick, ticks]"),
           "When it is closed: from the start of tick, for so many ticks")});
}

ShapePtr travel() {
  const ShapePtr leg = one_of({ticks(), list(real(0, kMaxTicks), "[ticks, metres]", 2, 2)});
  const ShapePtr row = names_to(leg, "a mapping {TO: ticks}", "", kMostStations);
  const ShapePtr table = names_to(row, "a table {FROM: {TO: ticks}}", "", kMostStations);
  return names_to(one_of({choice({"straight", "hybrid_a_star", "a_star", "dijkstra"}), table}),
                  "a mapping from kinds of workers");
}

ShapePtr routes() {
  return mapping(
      "a mapping of options for planning routes",
      {key("clearance_m", real(0.001, 0.5), "Kept free around the footprint. Default 0.01"),
       key("headings", integer(16, 180),
           "Steps of a full turn; arcs turn a divisor of them. Default 72"),
       key("reverse_penalty", real(1, 5), "Factor on metres driven backwards. Default 1.05"),
       key("direction_change_m", real(0, 5),
           "Metres that a change of direction counts. Default 0.1"),
       key("steering_change_m", real(0, 1),
           "Metres that a change between straight and arc counts. Default 0.02"),
       key("turn_m_per_rad", real(0, 5),
           "Metres that a radian turned on the spot counts. Default 0.1"),
       key("greed", real(1, 3),
           "Factor on the estimate of what is left: faster, and longer ways. Default 1.1"),
       key("smoothing_passes", integer(0, 10), "Default 3"),
       key("most_expansions", integer(1, 100'000'000),
           "Nodes after which the search for a way gives up. Default 3000000")});
}

ShapePtr order() {
  return mapping(
      "a mapping {product: NAME, quantity: N, finished_in: PLACE}",
      {required("product", name("a name"), "What is made"),
       required("quantity", integer(1, kLargestAmount), "How many"),
       required("finished_in", name("a place"), "The place whose tokens count as finished"),
       key("done_when", condition(), "Default: finished_in >= order")});
}

ShapePtr horizon() {
  const ShapePtr limit = integer(1, kMaxTicks);
  return one_of({limit, names_to(limit, "a mapping {order quantity: ticks}")});
}

Shape whole_scenario() {
  return *mapping(
      "a mapping",
      {required("schema", choice({"line/1"}), "Version of this format"),
       key("extends", scalar(Kind::kText, "a file name"),
           "Another scenario file, relative to this one"),
       required("name", name("a name"), "Of the line"),
       key("tick_s", real(kShortestTick, 1e6), "Seconds per tick. Default 1"),
       required("horizon", horizon(), "Ticks after which a run counts as failed"),
       required("order", order(), "What has to be made"),
       key("allow_wait", scalar(Kind::kBoolean, "true or false"),
           "A planner may decide to wait. Default false"),
       key("for",
           names_to(list(name("a word"), "a list of words", 1, 64),
                    "a mapping {VARIABLE: [value, ...]}"),
           "Template variables and their values"),
       key("workers", section("worker", worker(), kMostKinds),
           "Kinds of agents that move by themselves"),
       key("carriers", section("carrier", carrier(), kMostKinds),
           "Things that workers move and that hold material"),
       key("stations", section("station", station(), kMostStations), "Working areas"),
       key("places", section("place", place()), "Hold counted material"),
       key("machines", section("machine", machine()), "Exclusive resources"),
       key("operations", section("operation", operation()), "Transitions that fire by themselves"),
       key("tasks", section("task", task()), "What the planner may choose"),
       key("milestones", section("milestone", milestone()),
           "Names under which the log notes events"),
       key("map", map(), "The hall"),
       key("zones", section("zone", zone(), kMostZones), "Parts of the floor that can be closed"),
       key("routes", routes(), "How routes are planned on the map"),
       key("travel", travel(),
           "Per kind of worker: straight, grid, or a table {FROM: {TO: ticks}}")});
}

}  // namespace

const Shape& scenario_shape() {
  static const Shape kShape = whole_scenario();
  return kShape;
}

}  // namespace linewright::loading
