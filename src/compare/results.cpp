// Joins the results of several steps.
#include "compare/results.h"

namespace jalousie::compare {

void append(Results& results, const Results& more) {
  results.samples.insert(results.samples.end(), more.samples.begin(), more.samples.end());
  results.kept.insert(results.kept.end(), more.kept.begin(), more.kept.end());
  results.sweep.insert(results.sweep.end(), more.sweep.begin(), more.sweep.end());
  results.objects.insert(results.objects.end(), more.objects.begin(), more.objects.end());
}

}  // namespace jalousie::compare
