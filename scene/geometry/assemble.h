// Prototypes made of others, to any depth, brought down to the one level of instances that is traced.
// An assembly is taken apart into instances of its parts, or, where that is smaller in memory (few
// primitives, placed often), written out as one prototype of its own.
#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bpms {

// Instance::prototype of a part counts on from the scene's prototypes: prototypes.size() + k is assembly k.
struct Assembly {
  std::string name;
  std::vector<Instance> parts;
};

// Assemblies that contain each other, in order, the first one again at the end; empty when there are none.
std::vector<std::size_t> find_cycle(std::size_t prototypes, const std::vector<Assembly>& assemblies);

// Replaces instances of assemblies in scene.instances, each keeping its plant. There must be no cycle. More
// instances than can be held are refused (missing_resource).
void resolve_assemblies(const std::vector<Assembly>& assemblies, Scene& scene);

// The same with the choice made: every assembly that stands is (or is not) written out.
enum class AssemblyLayout { by_memory, apart, written_out };
void resolve_assemblies(const std::vector<Assembly>& assemblies, AssemblyLayout layout, Scene& scene);

// One instance as it stands within another, both scaled, turned and moved.
Instance within(const Instance& outer, const Instance& inner);

}  // namespace bpms
