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

const Work gibson{"Gibson (1958)", R"(@article{gibson_1958,
  author  = {Gibson, R. E.},
  title   = {The progress of consolidation in a clay layer increasing in thickness with time},
  journal = {G\'eotechnique},
  year    = {1958},
  note    = {Volume and pages not verified},
})"};

const Work audet_fowler{"Audet and Fowler (1992)", R"(@article{audet_fowler_1992,
  author  = {Audet, D. M. and Fowler, A. C.},
  journal = {Geophysical Journal International},
  volume  = {110},
  pages   = {577},
  year    = {1992},
  note    = {Limits of consolidation under sediment that comes; title and last page not verified},
})"};

const Work wangen{"Wangen (2010)", R"(@book{wangen_2010,
  author = {Wangen, Magnus},
  title  = {Physical Principles of Sedimentary Basin Analysis},
  year   = {2010},
  note   = {Publisher not verified},
})"};

const Work yang_aplin{"Yang and Aplin (2010)", R"(@article{yang_aplin_2010,
  author  = {Yang, Yunlai and Aplin, Andrew C.},
  title   = {A permeability-porosity relationship for mudstones},
  journal = {Marine and Petroleum Geology},
  volume  = {27},
  pages   = {1692--1697},
  year    = {2010},
})"};

const Work catalano{"Catalano et al. (2013)", R"(@misc{catalano_2013,
  author = {Catalano, E. and Chareyre, B. and Barth\'elemy, E.},
  year   = {2013},
  note   = {Discs with pore water as a finite-volume flow; title and journal not verified},
})"};

const Work mckenzie{"McKenzie (1978)", R"(@article{mckenzie_1978,
  author  = {McKenzie, Dan},
  title   = {Some remarks on the development of sedimentary basins},
  journal = {Earth and Planetary Science Letters},
  volume  = {40},
  pages   = {25--32},
  year    = {1978},
})"};

const Work sweeney_burnham{"Sweeney and Burnham (1990)", R"(@article{sweeney_burnham_1990,
  author  = {Sweeney, Jerry J. and Burnham, Alan K.},
  title   = {Evaluation of a simple model of vitrinite reflectance based on chemical kinetics},
  journal = {AAPG Bulletin},
  volume  = {74},
  pages   = {1559--1570},
  year    = {1990},
})"};

} // namespace listric::works
