// Laws of the tables: names, bits, and what follows from several rows together.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "policy/frame_policy.h"
#include "policy/table.h"

namespace jalousie {
namespace {

template <class Row>
void expectNamesThatLeadBack(std::span<const Row> rows) {
  std::set<std::string> names;
  for (const Row& row : rows) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(policy::idOf(rows, row.name), row.id);
    EXPECT_EQ(&rowOf(row.id), &row);
    EXPECT_STRNE(row.help, "");
  }
  EXPECT_EQ(policy::namesOf(rows).size(), rows.size());
}

TEST(Policy, NamesAreUniqueAndLeadBackToTheirRows) {
  expectNamesThatLeadBack(cullModeTable());
  expectNamesThatLeadBack(lodRuleTable());
  expectNamesThatLeadBack(lvMeasureTable());
  expectNamesThatLeadBack(detailTable());
  expectNamesThatLeadBack(viewTable());
}

TEST(Policy, ModesThatCompareWithSomethingTestOcclusion) {
  for (const CullModeRow& row : cullModeTable()) {
    EXPECT_TRUE(row.testsOcclusion || !(row.usesMap || row.usesDepth)) << row.name;
    EXPECT_TRUE(!row.twoPhases || row.needsHistory) << row.name;
    EXPECT_TRUE(!row.testsOcclusion || row.culls) << row.name;
    EXPECT_TRUE(row.usesMap || row.occluderTau == 0.0F) << row.name;
    EXPECT_TRUE(row.asksQueries || !(row.readsBack || row.countsSamples || row.batchesQueries)) << row.name;
    EXPECT_TRUE(row.batchesQueries || !row.joinsQueries) << row.name;
    EXPECT_FALSE(row.asksQueries && row.testsOcclusion) << row.name;
    EXPECT_FALSE(row.castsShadows && (row.testsOcclusion || row.asksQueries)) << row.name;
    EXPECT_TRUE(row.culls || !row.castsShadows) << row.name;
    EXPECT_FALSE(row.seesRooms && (row.testsOcclusion || row.asksQueries || row.castsShadows)) << row.name;
    EXPECT_TRUE(row.culls || !row.seesRooms) << row.name;
  }
}

TEST(Policy, TraitsOfThePartsDoNotOverlap) {
  gpu::uint modes = 0;
  gpu::uint rules = 0;
  gpu::uint measures = 0;
  gpu::uint details = 0;
  for (const CullModeRow& row : cullModeTable())
    modes |= traitsOf(row.id);
  for (const LodRuleRow& row : lodRuleTable())
    rules |= traitsOf(row.id);
  for (const LvMeasureRow& row : lvMeasureTable()) {
    EXPECT_EQ(measures & row.trait, 0U) << row.name << " shares a bit with another measure";
    measures |= row.trait;
  }
  for (const DetailRow& row : detailTable())
    details |= traitsOf(row.id);
  EXPECT_EQ(modes & rules, 0U);
  EXPECT_EQ((modes | rules) & measures, 0U);
  EXPECT_EQ((modes | rules | measures) & details, 0U);
}

TEST(Policy, TraitsOfAFrameAreThoseOfItsParts) {
  const FramePolicy policy{.cullMode = CullMode::kHomDepth,
                           .lodRule = LodRule::kLvError,
                           .lvMeasure = LvMeasure::kChord,
                           .detail = Detail::kTessellation};
  EXPECT_EQ(traitsOf(policy), gpu::kTraitCulls | gpu::kTraitTestsOcclusion | gpu::kTraitUsesMap | gpu::kTraitUsesDepth |
                                  gpu::kTraitFollowsError | gpu::kTraitFollowsLv | gpu::kTraitLvChord |
                                  gpu::kTraitPatches);
}

TEST(Policy, CoverageNeedsNoErrorsOfLevels) {
  EXPECT_EQ(traitsOf(LodRule::kCoverage), gpu::kTraitFollowsError | gpu::kTraitCoverage);
  for (const LodRuleRow& row : lodRuleTable()) {
    const bool usesTau = row.id == LodRule::kPixelError || row.id == LodRule::kLvError || row.id == LodRule::kPrice;
    EXPECT_EQ(usesErrors(row), usesTau) << row.name;
    EXPECT_EQ(row.followsCoverage, row.id == LodRule::kCoverage) << row.name;
  }
}

TEST(Policy, ErrorsAreMaskedOnlyWhereTheCoverIsKnownAndHolesDoNotCountAlready) {
  FramePolicy policy{
      .cullMode = CullMode::kHiz, .lodRule = LodRule::kPixelError, .lvMeasure = LvMeasure::kNone, .masking = true};
  EXPECT_TRUE(masksErrors(policy));
  EXPECT_EQ(traitsOf(policy) & gpu::kTraitMasksError, gpu::kTraitMasksError);
  policy.lvMeasure = LvMeasure::kChord;
  EXPECT_TRUE(masksErrors(policy)) << "no rule uses the measure";
  policy.lodRule = LodRule::kLvError;
  EXPECT_FALSE(masksErrors(policy)) << "the chord would count twice";
  policy.lvMeasure = LvMeasure::kPixels;
  EXPECT_TRUE(masksErrors(policy));
  policy.cullMode = CullMode::kFrustum;
  EXPECT_FALSE(masksErrors(policy)) << "nothing knows what is in front";
  policy.cullMode = CullMode::kHom;
  policy.lodRule = LodRule::kLinear;
  EXPECT_FALSE(masksErrors(policy)) << "the rule uses no error";
  policy.lodRule = LodRule::kPixelError;
  policy.masking = false;
  EXPECT_FALSE(masksErrors(policy));
  EXPECT_EQ(traitsOf(policy) & gpu::kTraitMasksError, 0U);
}

TEST(Policy, HistoryIsNeededByTwoPhasesByCountsAndByCalmLevels) {
  FramePolicy policy{.cullMode = CullMode::kFrustum, .lodRule = LodRule::kPixelError, .lvMeasure = LvMeasure::kNone};
  EXPECT_FALSE(dependsOnHistory(policy));
  policy.calm = true;
  EXPECT_TRUE(dependsOnHistory(policy));
  policy.lodRule = LodRule::kFinest;
  EXPECT_FALSE(dependsOnHistory(policy)) << "no budget, nothing to keep within a margin";
  policy.lvMeasure = LvMeasure::kPixels;
  EXPECT_FALSE(dependsOnHistory(policy)) << "nothing uses LV";
  policy.view = View::kLv;
  EXPECT_TRUE(dependsOnHistory(policy));
  policy = {.cullMode = CullMode::kHiz, .lodRule = LodRule::kFinest, .lvMeasure = LvMeasure::kNone};
  EXPECT_TRUE(dependsOnHistory(policy));
}

TEST(Policy, TheMeasureFollowsTheRuleAndThenTheView) {
  EXPECT_EQ(defaultMeasure({.lodRule = LodRule::kLinear}), LvMeasure::kThesis);
  EXPECT_EQ(defaultMeasure({.lodRule = LodRule::kLinear, .view = View::kLv}), LvMeasure::kThesis);
  EXPECT_EQ(defaultMeasure({.lodRule = LodRule::kLvError}), LvMeasure::kPixels);
  EXPECT_EQ(defaultMeasure({.lodRule = LodRule::kPixelError}), LvMeasure::kNone);
  EXPECT_EQ(defaultMeasure({.lodRule = LodRule::kFinest, .view = View::kLv}), LvMeasure::kPixels);
}

TEST(Policy, AListOfNamesReadsAsASentence) {
  EXPECT_EQ(policy::namesWith(cullModeTable(), &CullModeRow::twoPhases), "hiz");
  EXPECT_EQ(policy::namesWith(cullModeTable(), &CullModeRow::usesMap), "hom or hom-depth");
  EXPECT_EQ(policy::namesWith(cullModeTable(), &CullModeRow::testsOcclusion), "hom, hom-depth or hiz");
}

}  // namespace
}  // namespace jalousie
