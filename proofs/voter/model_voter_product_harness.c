// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// covers: model_voter_product
#include "../common/voter_contracts.h"

void model_voter_product_harness(void)
{
    const float weight = nondet_float();
    const float value = nondet_float();
    float product;

    __CPROVER_assume(model_voter_product_may(weight, value));

    product = model_voter_product(weight, value);

    __CPROVER_assert(model_voter_product_does(product, weight, value),
                     "VOT_018_product: a product by 1 is exact");
}
