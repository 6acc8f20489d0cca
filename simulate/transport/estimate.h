// From the batches of a view to its parts: value and standard error of every sum that is asked for, each with
// moments of its own, since parts of one path are correlated.
#pragma once
#include <span>
#include <vector>

#include "simulate/transport/sums.h"

namespace bpms {

inline constexpr std::size_t batches = 32;  // independent scrambles a view

// All parts that a simulation with this light gives, for `orders` orders kept (0: no split by order or
// component). With several suns each has parts of its own.
std::vector<Part> parts_of(const Light& light, int orders);

// The light of each source in the written bands: suns in their order, then the sky (horizontal irradiance /
// pi).
struct Sources {
  const Simulation* simulation;
  explicit Sources(const Simulation& of);
  std::vector<std::vector<double>> traced, written;
};

// One part of one batch, per written band, into `out`.
void part_of_batch(const Part& part, const BatchMeans& means, const Sources& sources, std::span<double> out);

// Smallest over bands of target / standard error of the total, from one BatchMeans a batch; >= 1: reached.
double reached(const std::vector<BatchMeans>& means, const Sources& sources);

// Write a view's light and its fractions into the result; `means` and `counts` hold one entry a batch.
void write_light(const std::vector<BatchMeans>& means, const Sources& sources, std::size_t view,
                 SensorResult& result);
void write_fractions(const std::vector<const ViewCounts*>& counts, std::size_t view, SensorResult& result);

// Leaves out the parts of orders that no path had.
void drop_empty_orders(SensorResult& result);

// What the orders above max_order would add, from the decay of the last two (a geometric series); NaN where
// unknown.
void write_truncation(const Sampling& sampling, std::size_t bands, SensorResult& result);

}  // namespace bpms
