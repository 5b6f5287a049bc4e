#pragma once

#include <string>

#include "sim/scenario/scenario.h"

namespace view::server {

/// The radio coverage of a scenario's access points, for the page's layer: the answer to
/// /api/runs/R/coverage.
///   {"x", "y": lower corner, m; "step": m; "columns", "rows", "height": m above the ground,
///    "layers": [{"name", "title", "classes": [{"label", "colour"}], "cells": [class, …]}]}
/// Cells are row by row from the lower corner; -1: not covered. If there is none:
///   {"error": why}
std::string coverage_json(const sim::scenario::Scenario& scenario);

}  // namespace view::server
