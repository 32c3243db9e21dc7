#include "apps/model/works.hpp"

namespace listric::works {

const Work seyferth_henk{"Seyferth and Henk (2005)", R"(@article{seyferth_henk_2005,
  author    = {Seyferth, M. and Henk, A.},
  title     = {A numerical sandbox: high-resolution distinct element models of halfgraben formation},
  year      = {2005},
  publisher = {Springer-Verlag},
  note      = {Original paper, accepted 23 November 2004},
})"};

const Work itasca{"Itasca (1999)", R"(@manual{itasca_1999,
  author = {{Itasca}},
  title  = {PFC2D},
  year   = {1999},
  note   = {As cited by Seyferth and Henk (2005)},
})"};

const Work baldwin_butler{"Baldwin and Butler (1985)", R"(@misc{baldwin_butler_1985,
  author = {Baldwin and Butler},
  year   = {1985},
  note   = {Porosity against depth, as cited by Seyferth and Henk (2005); title and journal not verified},
})"};

const Work kusznir{"Kusznir et al. (1991)", R"(@misc{kusznir_1991,
  author = {Kusznir and others},
  year   = {1991},
  note   = {Flexural cantilever; title and journal not verified},
})"};

const Work hetenyi{"Hetenyi (1946)", R"(@misc{hetenyi_1946,
  author = {Hetenyi},
  year   = {1946},
  note   = {Beams and plates on an elastic foundation; title not verified},
})"};

const Work turcotte_schubert{"Turcotte and Schubert, chapter 3", R"(@misc{turcotte_schubert,
  author = {Turcotte and Schubert},
  note   = {Chapter 3, flexure of thin elastic plates; title, edition and year not verified},
})"};

} // namespace listric::works
