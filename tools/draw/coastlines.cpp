// SPDX-License-Identifier: GPL-3.0-or-later
#include "draw/coastlines.h"

#include <cstdint>
#include <string_view>

namespace calotte::tools {

namespace {

/// A line of the data: its first point in hundredths of a degree, and the steps from each point to
/// the next. A step is two numbers, of longitude and latitude, in hundredths of a degree; a number
/// plus 2048 is two digits to the base 64.
struct Encoded {
  std::int16_t longitude, latitude;
  std::string_view steps;
};

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Natural Earth (naturalearthdata.com), 1:110m land polygons, version 4.1.0, in the public domain.
/// Sides that cut polygons at the date line are left out.
constexpr Encoded lines[] = {
    {-18000, 6896,
     "j1e0kGedf4fBhDfofphIkPfxjEejedfUdcf2f9eefZfreigDe0gjd7gdfpgsebgQeOfzfKgjgVgleJfogtfRfHfWf/f/"
     "eAfUd+gIhafLg8etguflgMfXfmfldFgWbpe1enf0dne6dvfDfbfSdxhFb7eyfTglegfVd6gOfge+eIefgDfYhyfqfzdu"
     "ejf8fVetgqfUdRfOfdeNdrfofieadwejfbhFfViSfIjegxiLhUg7gFgvibgXizh9ishni0hQhQiNeHf4fEetcCeTeuh6"
     "b+fecGdZhSfDchfldlf2gIhIdkgQeFfObOgSa3fia8c9aBcUidfzgxfChhfphAgzhuf5iReSgDereyecf3eJfTdgdqdv"
     "fee7d4eLd5eNfAfFd7fFfBf/fBgwd6e3fwfffagGfVfefifegDe4fNfqfufufafje+fwfUflf9fUf1f1gofwg4fUhWeK"
     "gZe/gBeNfafJelftexfXemf3f0g2gThLfUhphKgQe8hWfPgTf0ftfjf4f8gTfmgJflgQgcgsgXgMf3gSgag2f5gQfGgL"
     "fQgbd1fje2fReUflg2gufrgnhPhDfLg1epfcePe7fCe/eef7fNfSg1e8hSfwgDfThPfjhwhHhZfZhBf+gQfLdyfkfSfK"
     "eefOfNe6hsfJgneeg9ekhEezf+e2fCflgXfKg7fhfxevfmexfJf3e2eTevd9ekeJd2ekd1erePf1fDfTfeghfHfOd0fO"
     "eXfxfdeWfJf6fmhJgXgmd6ghfRfvd6eretehfqe7hNeWhdd+hbfCg9ewgtdHfzdQete+eNe/eueteEejfchAgchEe1g5"
     "etgOfXg0fNhoengueqf+gPhOeogAf4eSfKduffengHe4hBf9gpelgSepg4fHg8f0g0fMgXf3g7fEgqe8gGe9f1fTgKfd"
     "gHfFgkflgnenf+fee5f6ehhKeKhPf0gzfGhDfzhTfcg2gLhJfqgqfYgnfvgxfLg5fPgvfwfFftg4gLg+gdhgf3hLgfhM"
     "feg7gIhtfXg0fgh4fuh+fUhTe+fOePe4fIgJfCgYgjh8frhdexh0gMgkfGgNe5hRfjg0f7gzftgwfWg7ekgDgJfXfgfJ"
     "fWgUfxfufkgLfZgJfyfbe8gBeFfsgFe0fLfFdwe9eQeKe1fBece/gAfSfOfnemfcfSf7fhe0gVd+gGetfVehgAdWfMf7"
     "fTe0geffelfjfee8fYfkehhdfSiMfahlfdgvfKhgfoh9fug/eliJfXjCfiiAgAh5fthedufEe6gMd+h5gvgkfjgneLhV"
     "e2gafjhHeyhMdIfudef+dzfydDgeeUgXePgNfVh7fQgRezfuecfQeFghebhNeggde9hee2iGfLfwfAghfbfZfFgFgUfT"
     "f3fqghe0gneqgxfpgRfdhEfWgGfXf2fegNffgdfkgNffgPfnf5hJgbg1gcgLgefggCfGfqfFgTfZgSgFgEflhOgQhSf9"
     "g9f9hEhEhLhAg/g+gdgigNf3f2fXfzftgOeygte7g3fchKfzg7fugtfGgbffgkfzgAfqfbfEfwfkfWfgfbe8fSgFfsfo"
     "fwfOgMe9f3f0fSgAfBfaf2fQfpfrfCgAfZfngAfYfQfkfJgJe9fffSf6e4flfsfUf+feecfWdgfRene5fUf7figGfFfW"
     "fBftesf7fnf6fqfmflf4fxfnfOgCfgfze7gFfmg6gDg3fwgdfshKfjgpgVgFf1gugMgTf8gsfzgrfigef4gnfNgkfKhU"
     "fkhSe7hEfTgRe+hff0hGgFg7fGhvfSgnfKgVfeg5gGgWfkg0fjgXfZhKfDhRfNhEfOgAgQg3gEgjgMgof9gOfkfYfre0"
     "flfMfofvffggfTgte4iPf2f3gpeWg+echLdkglfKghfHhZeSfsfugEe/h0engSfrggeefqfugOeZgleIgmfog3fbg6eM"
     "gcekg2fQiJehg3fHg3fGgffegxfigYfhf9fXfHfogqfkghfugUfXgtfWgxf/hfgahsgMhZgfgxgGgkgTg5gDgggCgugP"
     "g1gKgvgigmgAgCflf3fGgBfLfqfcfkeUfQeQfCeAerdueqeQeKd4ecevdreceje0eSeHfpfLfqfpe5fYfofWfaf5fye5"
     "fgfYfte9fXfffSeFgGfHhAfcgDfmflfEgFfhf6fQgjfCgpedglfqgQfTf8edgMeogEdkgSfPfie4fZe7fAfCelfaePfP"
     "ePeVfafue6e5fXfpf3e4gwe1gTfFgCfigRgFf9eefwfSgYfufxfXfWfceufeeHfKfUfbgJfWgaf5f3fMfne3f0etfmfT"
     "e8fNftfyfVfNfkfNfHe4ePeZe6fEe1fSeXfZfNf7fzfkfDgPfPfteTgUfEfzfWgGeZfYerfwfCfafSf+fWgkffgCfUgs"
     "f8fyfygbgBg7fghDgggSf9hNe/hdfOhVf/gAe5iCe1hMfZhJfqhhfnhJffiaf9h3f0g3fZgpfMhTfMh4fqg+evhif5hN"
     "f3g/gOhYgihbgGgrgghagYgpg5hCghgsgKhKf7g5figkflg8fog8gFgVgfgofhhgfshDfOhAgJgTfygfflhLeuhqeahl"
     "e+hTfDhngDghgWgggYhJgUhKftgPgjhwgOhPfahCfSgRfsgtfmgPgBgbeYfcfagGfafpewgCfKg/ffhIe6hCe0f/eogA"
     "euf0evfrdjfFfJfeemfjemgdfTf+e6gUfAf/eKfue6fkedfbftgCflgAeZgvemhMeqg3e9hBflgHe4gofMg2fvgkfzhK"
     "fUg7fagofmgNfngUf1gsfxgWfjgQfKgqfWgHfqgcgAgPfigVf5gWfwhMgNgtfWhNfPgkgsgTgwhGgYg0f3g1gcgygMhe"
     "f1hjf0gxgKgyfmgwfMgrgEgqgFgvgmgbghg0f5gigjhGg4hAghgQgbg6gCg2gkg9hCglhAhmg0gohdgLhPhEgygbhUhT"
     "fmh9gnhWgNg1hAhDhkguhLgphDhogfg9hKgAg8fVhfgHhofqgrf/hgg3hsgRg/gphhgfipgRimgIgyfyhegnhrgBgpfp"
     "hEgGhtgohGf0f9fNhVglgHftfOfPf/fSgjfnfzepe+fOgTfKg0f+gZfQgmfxh1fdgqgJhUfviEfUgvenhafsiNfWhrfP"
     "gxgagvgufphMgfgxhIgvhFgNiHfsgjfTglgAggfvhjf0gZffiEgChhflhjfjgufwhNgggpgchZgJhHfzgbfOgXghhQfo"
     "hOf7gygZgcghf6gGgagugUhMgPgZgDgBgjhSgyhGgCgEf2hMgZgpfbgugmglfDf3esgYe8fGdof1evg1eUgEfpfWe7f0"
     "efg2eTf+fFhje3g4gwhOfBgvhvhgiagEgqhMi/fzh4hBh0gcimgCiue6iQfZh0gPhWf3h2g1gPgqfnhEfHglfIgMfbgf"
     "eBhUeOgmeqg6hIgRhThTfIgoiUgpf9gVemfwewf4e+fgeif7eqfagGfCgxfohmgGfsfceTfvd4fGfJgVgWgueSgegSgT"
     "hgghfjgXdkgZf5gmekfzfbfJeye2gDfnfPfqfigJfkeIfMfWfce5ggfHgLfZhYfgfufoeJf6fVfhetfKfggvgCgUfDgD"
     "fLgKeIfmhFfHfNfwfIgAfMg0ftfqgWfEgyfRfafqg4fSgxfjgCfHejgbgefNfBf1gleoe+f/eugsfbhPfuhDfZgufNg5"
     "f5gdfvgGf+gWfJgif3gwgIhEgOgffvgQfrgIfkggfVgUeiglfGgkekgeethJgUgIfSgqf+gifAgPfhfVfjgigCgigDgC"
     "gXgJewgPevfcgFfPf0fjghfNhefOgyethvewhOgAgZfqfkfshafchJfihWfMgKftftfcfJgvepgQfWfAhIfbf0fLfWf6"
     "fLerfWf4gBgfgUg1gWgVfZg6fhgzfXgMfigsfAgSfVgoe2gGeyguekhBe8g5fhhjfOgMevghfSfyfGfSfXf4elfIc7gb"
     "dufff1fEgFfGehe+eAfqf3fffDfIfZevgnfHfGfTfre/e0fse5ezeCf/eggCfBfcfafbfPgIfbgifkg5ejgQfXfmfMgO"
     "fMf1gPhOf3g+fTgJfogmgIhBgoglgHgogVg8f+gqfsgkf8gigFhHfXgsiNhIh6fuiHgAhqfvhTgGiif8g0g8gTjHeYhp"
     "e3gzdngnf2hIiBgWiofmfghyhffVjphOgehShXgUhQgUg0gbhYiTiJgqhTf9gTgVhUgGgSfqhEgxfpgmf8g4fXg4f9hm"
     "gRgbgcgehYgGgkgchQgcf9fNfiffgMfkg2fxfofafigLe4e4gbfPgCfahlfof/fdhmgTg4gbhxfZgvfghEgdicguh+gi"
     "hkfvgIfohgf/gXgsiKggfqhUgEhLgxg/hegihQe2hQgCgThMgMg7fbf0fBgjf3g6h+gch+gOhtfwhngDhyg3eXgvdLf4"
     "dQfcddfrfGg2efghgWhifQhbgwg6hag/jlhshDgVf2gqd0gwdUfjefe7gQfCdhewc/eqe3dzhHe6hgfIekePeYfpfadY"
     "fHeieHgKfHexeMf7fghfethxe0iOe9g9c6eMd7fpd1gzfdhrfgjnhchBkIhTjGhoi3iLjwjBiohLkSh+jcgsikf6iZhT"
     "i2f8izgUk5e2d/fmhufBhngjikfDkSfol6ePhNfRgHe9eRfMdcflZChMe2fzije3gNdriBfihOfmgNgwfCgthCgkjxfC"
     "hVgYe8hKjphihdf6hdfdg6hFetg7gxg8e2g+kYfgg5fIeCf0gAfIhPfeiagVgZhAjRgwldhWhLf7eefDh8f2hHgii8gD"
     "iUgphyfEhyhCeXg6g0ghknfiiLfglqeOhDg1eag0f+gWeHgJghgwfKhOf+ggi4hahBhbhLgUkJfmgUfIeievg+fggge6"
     "fpd3hvfDfVe9c8dyhyfxgogkhugagbgxhWgwfGg5gvhCeSgIfog4hQhkd+hSizhDfphHgygDg0fIfZeghrftfShIiogo"
     "jPgFi5fHenhTf2hriugUjxf8jYgNevg0h0hChygCjDgykIgNgigckGgJhSfqjgg1i4f+gcgrhfgrjsgpisffd4fojifw"
     "gbfPhbgYklf/jhfPhQfbfofMeRfib5fJe1fih8fyiUfnhagTgzfAgsgZiggQlBfwgYfRmifxgGhNjUfuiggBihfLgufA"
     "fFfWh9exiefYhghpihfTiqgbjCfhhJgcikfye4hdiEgruHe/hVfFkGezmUgTjHfwhTfWf0e3h7fkiGgUixgDi9fsi+gL"
     "iuenh8ggevhAgsgtk/fkjQgGkgfQiMfU"},
    {-9055, 6950,
     "gAeZiGhPh3fAfie1hhe9hohIhJhWgGhuiOf5iUfxiGfOgGfPe2fKhGfLfzfPc8e6d1fxeZgefifOegerfjfVeMe8dxf5"
     "exfWf5e/eMf0eFeueUeQfZexf7eMiTfvgtejgue0iMgUi6fUhkfahIfRh9fkhqfWilf7htf2fvepgfechJeQiVehhNgg"
     "g2hnfMiee5g1iggvhxhGg4hFf4hDe8hVeGhMh2hofVhbfeichGgXirflhnf2hTgahdffh7fGgffZiyf4f9esgheChcfw"
     "hIfFiRg4hfhuhDgvhNemiDeBhueIfYfBiFfIhafGiffnhBfggnerhOfzgofagIeQe3fae4fddbfdeDetdXfwcqgVdqgB"
     "eYf5ese4eBfUdwd7eMekhVgRihiDjShTiWgKhYfPehe9ggeUghe1iCfOilgOhkhxgHe3hBfceEe+cjfFecfYeRe4e0gH"
     "f8hViuhSdff9eRf0gRffeWfQeZfdeWfifHe/f0fvf+fLgifMgpf9f2glgdfpf5fke8fwfQgCe2fufVf7fFf7etfjiTgT"
     "geftdzfifBgAgDgMfhfkgef8fqe4e3ezf5gafqgFffgZgVfKgYfugCfafgfafIewf3gEgfhEfNgmf0hTftfVgVfAfBgP"
     "hCfhgEehgdf5gKfdgOecfBe2eYfie/fGfOf5fNfbfyffeSe/fHfQfRfFfxe5gSe7gheqgte5gAfVgveMf9e9f8fZfnfD"
     "fifzfPgMfwgsfagXfLhWfRhMfxgogVhCfkg3eyhUfZgPebfTfugFfQgufBgZePfzengMe0f5fVfygUfjf+fYgVfsftfz"
     "fbgPfbfte3gDe1g1epfze4gXfBf5esfpele2edfVfJfQfpfTf/e7gFfQgTfefZeofve4f4d6f3fPgRfKgffPgUezhCe1"
     "gYfHgnfPhqflgpfWhYgchMgLhLgSg/gRhAgogYg7gIhUgRgdhEgahqgXhYf9g9gIgYfrf8fQfLfFfofDgSfufxfVfney"
     "fngafrf+gAfxgTgAf/flfvfUgJfxf2fcgGf3f1fNfsfmfuf8fsfeggfugJgOgef0gKf8gWgRgcgCgKf4gPgFgvf3gugC"
     "gggLgMgMggf6gXf6gbgCgUgJgtfygQf9gffugdfpgkfxgaflf4f2f6fqgLfbfpfef1fYf9fUgFfmgDfTfwf2f3fVgHfm"
     "fsfmgEflgPfwgafKgmfXgvfWgkfcf+frgof7gJgIgcfogxgHgrgZg8gUgjgeg3f6f8f3g4f8gtfvggfigmfkgzf9hMhG"
     "gpgKgBghgShVg5gug/gCgIgVhPf4hOgygngXgxgwgjf6gaflftfff9fofFf0ghfTf/fMfUfGglewgsgHgWhIfhgjf7hM"
     "h8gpfzgvgjgfgke6hGf+hBfJgEffhZf/hrgKg5fThNf0g4gfgBgZh8gGh4gCerfigifRhQf4hMfPgQewg0gCgnfphCfb"
     "g+e/gCfMgmf+g2fPgnfdh4fsgLgShRgIhrflgif1hKfohqesgQfXgigEgZfJg4dRg2fwgCe7e1etgffiixfxgEebhMhC"
     "h9fcimfDgxfFfwfJh0gfjDfLiVgEiUetiAeQhNfjhVf8gkfhgieAgRfEfYdafNe/dzd1fBePe2epfnf+fke3gHdEfkdm"
     "f1e+fhfZfud6ead+fveYevfVfpfEeTgAdjfae6fTeQfjeKewesedfxe2gQfIfuebfpfQe6fJeRdPeoexe8fRfTehe+fH"
     "fUfBeQfJe2gUfJf1ekgre8f9fDg3f5fMiAeqfye7g+fVf7fPegeAdsfKc3freSgKgWfFfre1gSfNfEfdeafyegglfZfm"
     "gOechEfig3gggdfMekfhewfCfxebfofKeigAeyfNfje1hie3hgfrfdeneKfHe/eLelfYfXfSggeYhDfGfWgFengBfQfn"
     "emfcfvejfWf9ePgheOhGeDg5fhg/gcg7fOhCfzirgrhghphNdogdhghZgiimhvfdg0jPe9gafheDfBgOgfiPgii6guhE"
     "fkhif3hwgqgEg+ihhFiggqiVfpiWgehSf0h8g7h6gSjBggjQgfjgf5ijfriNebg6f4gpc5hkdNhtezg+fXhTgQgderiD"
     "eei4ehjHfXgufhhKeyhBe5gogggtfQhfgfhGhQhAg1hKfqgsfafRfEgsgUgdfwhagigPgTg/gmhAf5gpg3gVhEgofzgf"
     "glgIf8gygXgkgygHgqg+gmg1fbgYgTg6fqhbgVgafwhVfYg1fegdfrg2gZgbfmgHfughfOgcfUf5fsfefYfmfqf9f2fr"
     "gvfKflfzfyfxfRf7fvg8fzfvffgGfsgofXgHfmgLfVgAf9fqf1gPfJgXfsgVgMgRf8gWfkgYfZgUfdgNf6gdflgSgHfj"
     "fsfofpgbfggKfygVgBgegNggfkgOgXgTfdgffRgpfrghfVggfOgtgLgQgRfwgHgHfvggfigJf1fofGgBfcgKfWgUfJgG"
     "fjgWfNgRfCgCfSgUfKgpePhsfMggevgafIf5ewfafNf2e6gbe1gTeigue1gOePguesgwfngbfIgGeagffWgueVg5fOg/"
     "fogwghgKf2gdgXgagAgiffgtf3gofegyeohkebhOfQg+eqgpfugZgPg9fNgYfFgwfnhGfKgIfGg1fRgxf8gffKhLfchN"
     "gCgme4gofef7fHgcfwfXgRfQgKe1gifXhKe7gRfpgPf5gNfdgSgCgUe/gefngWfcg+fNghejgefUgcfSgFfLgxf9gofS"
     "gkfTf+fvfWfbfugAflg9e/g5e4gxfNgZgDhJfxg2fQgfe8gtfyfzfngafDgYfEg6gIgIgpf6glgmgEgtezhHfFgcfbg+"
     "fbhCfShQfXhZfwg0e/g5fRgMf1gdfIgFfcgbejgKfngQf0g3eehketiLgEgXfUgheyhUfzhSfKg2gWhTf9hWfghNgnhe"
     "gYi1fuiGfghWfjgugMgUiRfeg1eigZgafwhSfehSfygAc/hje4grdLgpfJhZgOg9eAgrfvhQeHhJf9gzfJgmeoggfkhX"
     "d/hRfKheeggHdhgCeLgdcxhoehgTdRgjd1f4c7gueKgreQfqgVe7fJf5eMfseofeeSfrfxg6gthjhqgeflgZeBfJe7e9"
     "dwe5hJfPeie5eUfWecfhfnfUdkfMfhfReLfWe7gHejfkeafeetffdUfjfxgRhtgvhigfhqg3h9gLgxgpiLg8gWgUhKgj"
     "gRhMgzg7eNfiffgRfKfbe/gzflfcfbgyebfYfDgAf4g8gSgke/gkd+ftesgve7gYgAg4ezgrgng6hRg3gkg0hRgHhEfw"
     "hRgwhIf4hNgfftgtfIgShKgnfDf/eWfqfhfqexgWdzf1dugYfVgoeCg6iMgqjggxhSgAfyfOjTgEevg9eFgne5gyeggq"
     "d3ggg4g0ixgDh+gugYgxhmgvhigMi9gshcf5iag2iXfrhJfTgsgTipf6f6fpiZfvhmgKjTfgjAf3hNfziFgQiYfihsfy"
     "i7foiefQhof3hXgqh5gfiVf0iWgrikgZhEfXhLgXgWgvhFf2iqemiEhEgOe0h7gQgmgeh5f6iZfWjqfbiJfvhigHiHfN"
     "d0fOi0frkOgMhVgRhrfEhtgzeagqhAgih6gFhQgKhRfohkfKhwgIixfTibgQiSf9f0g+hZgSibfef/ehhAhQhQf9guhl"
     "eUg9eMgpgIhuh2hJiEfwhlfUiIePenfPi6fs"},
    {-18000, -8471,
     "gGf/hYg6i0fhgMgDgcgJgigKgdgJgPgEgOgAgLf+iRfXh+gpgXgGkmgShffogvf0iXffkcfmjhfhmCfpkggbmpfsjxfh"
     "kIgekWgbgWgvZ2gEa9gXesgobzgVgSgtglgpgmgmfsgpdZgbe0gkdlgfjzf6jngQiRfeiygeilglhQghfdgpd/gcdtgd"
     "cygGdMgOc+gKe/gld/gfeygjfhhygxf2hafhikgKifgNhSfVifgKiFgWh9gbhyghiWgKf8glfegmgdgjiBgSg7feiZgU"
     "hzgZiPgCiHgKiHgYhsgVh5gWhPf6hEf4iVgOiGfuiJgCiDgOiHf2iVf2iLgEiRf+iVf+iJgEhmgeh5gPh+frh3gRhsgj"
     "hAfhgjfdhBffhogdh3fbiHf0h0fliNgFiAgSiWf8iHfyiKfvg0grfAghfPgkd+gHfIgmfqglfdhKhMfziDf6iCgGh1fw"
     "hmfigrfdiHf6iCgOiJgUh7gLhmfpiFgIhWhMhRfThzfuh+gKhSfZiDf8h5f0h4frhOglgngjhkfZiKgKhlfqhFffiFgK"
     "hogVhmgah5gOiNgLh/gOhigWg7gfgXgrf1gpfhgnfcgofhgnfmgjf7gngJgogvglgngpgQgnftgrf0gngxgtg3gehAgl"
     "hFgfhQgegngrg3gbg/gahggGg/gfhGgUhSgLhJgag4gfhPgMg7fmfaffebfjfUfqe2gQeuf2e7foe4fnfPfjfyfZgGfa"
     "gvffe8foeif5fJfefFfhfBfVfwfbgkfWg1fhhSfphMfggpfZgWfbgdfZgvfegefbgNekgefbgIfZgffYfyfLfJfXfGff"
     "d7fyfTfdfDffdpfbd7fweCfqd5frewfWdff9dQgDdhf5dYgAgffYiZfvhwfkg/fdeQfhdTgKdyfmf5fXf8fZh2ffgWfa"
     "h/fbjUfwi0fliPfhi2fgj4fxj2fkiqfji6fehifRgxfbh5gjilgeiugfjQgaiygbj5gCj0fyjKfphBgriLgdj9gCjGgW"
     "i7gVjQgOjdgSibgZe5gkfWgjgAglc+f8cyfwc8gAfkgmgOhKgtgWiPgXipgYh5gdh6gdhagoiJgRiHgOhEgIibgEiTgN"
     "h8gUh5gYhugXiLgfhYgihegdgdgneXgYgjgphCgfhogUhugXhmgghOgngxgvhJgch3f6gxfeh3f8gEgmgzgnhsf2gZfb"
     "h4f6iBgSh+gLhxf6grfXhughhmgShxgOhwgOhmgXhvgQhXgVg8gkhLfmhngOhJfRg5fdhxgTgtgnhmgciEf6gnfbhSgl"
     "hsgMh1gDhqf/hvf0hsf6gvffhBfihtgSh2gEhygAhvgChkgNhqgMhYgchegRhmgKhMgcg3g2g5gihofwgnfdhWfohogI"
     "hHfdhKfmhmgYgjgrhagShoghhigOh1gThPgWhSgXhOgWhef0hagjhBgchef+hTgXgTgkhUgbhSgUhkgPhdgIhXf6hff2"
     "hQflgKfVhYffg8fkh4f0hCflhTflhgf6hQgThWgphefrhif0hef0hif5hkgAhSeYf8fmf0fTehfnexfbgOfYhvgCfzfZ"
     "fNfbfRfXhMfgh0f3hzgRg3gngigmg3gfg+gdgZgkg1gwg/gKhygEhjgMhmgQgxgngeglhEglhigahUgTg4gig4gRhJgQ"
     "hjf2hagKhigMhuf6hJgbgzhDglflgvfQhUfthgf4hggMhmf4hef+g/gKhUf6hMfqhagOhsgAhcgOhofyhDgigyghhFgb"
     "h9hLhBfyhMfkhDfdh/fDhif+hcgAhsgMhrgOhTgbhEgehwgEhKgVhPftgzfghGfhhugEhEfnh4fmh9f2hogIhOgfhDgg"
     "hagIhafyhof2hegQhagAhYf2hcf2hagShsgPhmgEhygAhbgKhbgIgbgxgEgpg/flgRfTgifWgpffhUfuhygGiDgChagG"
     "iDgAhegCiDf8hwf5hHfgfsfbhBfjhrfohwfmiBfviHfwhmfxhyf9hAgihZfkhMfhhYfph6f2hzf0gxfZhyfohMfdhwfw"
     "hzgChsf6h3gCh4f5hwfyhnfohofthHfif0fZfLfdfTfTfdfdfRfWd9fxfFfcd+frfTfZe8fae4fhfWfXfnfbf2fTgCfa"
     "g5fZgWfbgufdi6fygofVdLfwdofrdCf8erfHfvfRfVfbfLfaiFffgzfXhWfbh6ffiLfgiWfhjlfgg0fPkgfrgTf4hKfj"
     "kVgZjlfhisfo"},
    {14356, -1376,
     "gkexhAgmgifWgvfYf2fUgWeqgPfPgZfzgberf2fMghe8hsfMhHfQhDfVfzfog5fBgneUgogWgofUgZgQgReWhHfCgufa"
     "hPevgcewgCfHf5fCgwerf6eofvfRflengCfHfse4fUele2fPfbeyfffPfieqfafOfne1fze7gFfgfGfeeRf8ejfXfSfZ"
     "fEfVetgtfDgRgPg0fKfteoe4eqgbfHgQfHgHefgde/g+fuhMfpgyfOgpeggMghgwfohKfPe7enfug0g3gQg6gmgxf4hK"
     "everfBfefaeweygpgDg1fBhJfMglgSgXeAg9e6gDeggwdMf3d/fceOffehgGeWfNepfpftfMfbfXerf+fBf3eogSe4f1"
     "e7f7fFfLfjgFfNfjfRfhe2gDe9gAeWhAfLgTgCg6gxgNgRgXf9gkgMhFf1g8fLhlfwg5gEg5fYhBf+gdfTgof0hPfHhP"
     "fygqgsfVfehdgyfjgdfZf/gzfOhPf3ggfogegLg5gVgZgNgyf2g7gphHgHe0grhFhRgigxgqhMglgtgIgcfzhPgmg9gL"
     "gPgWgagJg3f9hqgeg2gsgZg1g7gzgFgogCg2hGhVgqeqgrgUfcgvgggxgsfqgMhMg3gxgYgogygRgCgcgsf0gBgZgsgP"
     "gxgNhJfSg4fFg+f/hAf3frg3gwhQgtgafwgZgsg5g8gkgzf0hVgTf+gze2ghg2gOhCfng1fXhUfngdgKg+fhg6gdgmf3"
     "gXgTgufPflfKfbfYfdf9gMfYfifOfdfOgHfkhQfJhNfggzfdhIfFgdgAg0fngPfhhgfehBgigUg2gUgsgNg3gehQfygw"
     "gHgdf1g5gNhMgTgUfxghgYg1gTg3gCgdgmglgcfPgHfCgZf0gEfVgkfOgIfHf8fc"},
    {-2710, 8352,
     "pxexdIfZaBf8Xmf2gyfuligLktfejDgehTfceSfGj/glnlgnksftg4fVZpe5fHfpbAfvjof7eLe3ewe/gDeRh4e+djf8"
     "dcfhi5fLgXereVf3iCeqcif4hzfYfgfcdzfxd0gAh+e8gBfTc6gqfNfliHfniDfDgmevdNftezgneFg5gie8eMfMkHf7"
     "iKf7b0epbwexbcfdeRgAeZfad1eWcpe6e7f8d7fndwfpeqfCf/e6fNe+ddewgoeyfTetfNefdzf6dthRc4gBefg3e9hh"
     "dTh9fNhBfyhad2hcgkhKe9gjhjh1iWglgogqgVhOeNfcfKfyemfxeGghf5hEgng1hdgCjMfldUg/emgjedfyetgZhvhd"
     "fDglexhFeHhqeBgngBgqb0g6csgIb0f8cNf4eLggdTg/kGgfjKgGZUgacegogOgnl7gwlugxgngkbygkhXgolahFiRgL"
     "fXgtjtgakzgQkzgBhufhkJg3jvfaiMf5jQffcSg2gOgrlPg8lff7iAgllhgKsffz"},
    {-8656, 7316,
     "hPfBhchRj9gpiseZfxe+jGgdhfgojdfNiKfRgNfUi6gXhofAjxfYhXfYhfejdIfRjse/iffqiQekidf5fhe6dQeMeFgr"
     "djhgd/fzfzfHhpfGiIfSgpflhBedfee4eCgccFhQiNephofEgQfdbxgocqg6eGgxgjgcdrgzdugxgCfjbffwesgihBhK"
     "i8gCjOgNffgjgigyiChhfkgtfagidngwc1gihAgaeWg+eogGexgifLfidKfzaVgXcsgddegPetgjhogudygAfhhmhMhZ"
     "hngpkCgae3fA"},
    {13414, -115,
     "gcdehofEhThqhzg9hZgAhWfdhKfchrftiue7i4fHhFfNg4fNgPfFinfDgYfLekf1gWe9hae/hAeVg6gEf8fUhNfvfift"
     "hqfWf1fje+f5fngaeqgLebgPezhAfHg3fMhXd9gsesfjfDffgMe3eyfdfIgReYgEenhSebgUfnfkeBf9grhRg/gcfmht"
     "fQhUc+hUeugJdphcfjfQfZf3fqgkf/gse0gxhsgkhHf+f4gbdtgAfZg7emgTfWgxiHgYgzghigfXgQfb"},
    {-6850, 8311,
     "kLf4jXfzi3flf8flcMfVcOfselfpjagBcUfDddfkdVeucyfvfAfsbRf1iKf0e7fuhTfPehfddlfkfRfZd0figOfpirgE"
     "gCfob1fEb7gbbafxdrgMdDgFfzgwi5gXfPhIg9gHkLfVd4hAdegThRgnixgYgcgjdzgnfWgzkRf8hPf1icgkcfgMaif6"
     "dPgietgoeLgdfqgjiVgSh1gEjEgQiTglh8f7hsfkhMg2iEgQizgLkygEg1f1khgRjYf6jZf6"},
    {4911, 4128,
     "gze5gvf8gefleuf4fueyfwfdfbfpgCfOgge2hffrhFfOiOfvidgagJgYfuhHgOhoeygigahFe+gFgWhVhefnhYgge3g8"
     "fjg5ewfnf1e2fhhBf7gZgYgpftgjeMgifThafJgZf9ghhhf2gEhKhVgQhXfxgShhfug+ecf7ergZeNfUeifrfTfFeffv"
     "eceZhbehf2e9hteKg1fL"},
    {5006, -1356,
     "gQeIgafRf2fQfufjfeg7ftfigTe2f4fWfkfof5esfZeLfPd2fCdDfad1fTeMeufoepfWfGgZexgkfkg1f6hZfdhPf2hI"
     "gShIgugSgBghgwhMgJg/fogwftg/f4hcgjg4gOg/gxgEg4gVglgSgsgBg5g5hTg+gdgyfzgrgqf0g3hFgDg8ghgtgifV"
     "gbfVgZe+"},
    {11787, 183,
     "hxejeJf0ffe8gEemege7f9edfadnfxgjeOfTfZg9e5gGfOggeJfcfbgwe/f7etgMfxiGfOgcfQhVfyhYgMhcg7hDhKfd"
     "hNgTgUhVgrgTh4gVhHhPgyhAgnglhVg3hNhFgzhOgogBgzfNgFfVhCfkhTfif5fZe9f7gSfPe2fefHemhKehfufS"},
    {12524, 142,
     "ewede0fteggTdaf7eofyfye0hZeng2gti7gif4fSfUgPfVfFeofZheeAfufehaeNf/e+fLfjfZgjgwhSeefZfngcgNgm"
     "e4g7gHhhe9figJeLgEdxfBfyfVgdgchcfxhhfWgAfhhFgphBgOhQgziWgUgqhWhKhOfih+fzhzgEhjhIgRfq"},
    {-11417, 7312,
     "fOfRjfgeiLfOhxgzhbffhSeegygpe5hnhYgPhkfwhwfXg/efgfe5infPi1fRf1fUdcf3hAfafefbdLgQdUgbeMf6dEfe"
     "bXfvd6f5fJgvd4gbenf1eFhPhCgLibgRiNf7iCgSc/gXcqf4dygCfMgljogodmf+dRgbhUhLhFgokMg8hmft"},
    {-300, 5863,
     "eVeUhmgOhtf/fmevememhnf6hid/hEfwg+eOgcfZh5ftf0fAfNfjgofMemfMd6gBdWfkfRgUe+fRekgLe6fafKgUiThp"
     "hagWdjgQfjgohpgffJg2gThCiVf2gOg6e8g/eHgSfogbgkgtffgbfKfRf6hgfOgzgkhohOhRhQf4h5gI"},
    {-7968, 2277,
     "gofbhdgLgkfphUfCg/fTghgBg7fsf5fjhKf8hLfXf0fpe+fze9f7e7gIdwf3hDg3fYgae/gHfegdfog5fHf8ejgbfigV"
     "d+gPfdgUgmgZedgFe5fMfWf+fyfofOf1fWgKg0gfgWgkgtgWgzgThMgKgYgLhWf5hPf/hefe"},
    {14098, 3714,
     "faewgRfOfMe6eAfRdRf6dxeNe9gnf8hLdSfqeKfQeLf/hle2e9dWfAfWfPgngZhafBgdfXhFhfgeg0g/hlg0hJhEjHge"
     "hrfshoixhDfRiThkg5gng+h6fvhwgrhAhqgSg3d1f8evekebgCeZ"},
    {17461, -3616,
     "hJeXgChEgtflgPe0hQfghEf4g5gmgzf0foeofhfFe0gCflfigJfVfyftfafKfOe8ezfYfvgafWgPg6hSffg3eUgogDgk"
     "hIgjgRhNf8hBfXhDgDgSfQgpeyhYfVhHgmgIg2fIhOfmgcen"},
    {-7258, 1987,
     "hXfwgMgRhOgAg8fmgagDgSfcg3gCf8figtf9gxfbfbfYfQgVfTf8ffgFfufufZf5fxgZfffxfYe8fmgQf7gce+gRfRf5"
     "fDgIfRftfKgfgJgghcfzhMf4gkgWfSgrgBgmfBgQgWgcg9f7"},
    {10582, -585,
     "eRf+eshTd/hSfWg9e0hRfOhLe0iMeohTfjhWfbhOemg/fMhWe1g4eXhuf3gzhBf8iafthZeehNe8g3fWhfeVhmf+hUe8"
     "g6eshMfSfYevg5fdgkf+gRe6gjfIhJf3gxfBfneDf8dm"},
    {12132, 1850,
     "g+fkgegagKfmfvfXgie4fmetfFfffxewgWewg1f1gsgMh9fIf2fKghfof2fSeygxfbg0fmfcfBg7elfyfOgWgFgpgfga"
     "figXfzfcfPg5fxgsf8hfgpffgKidgghbg9f/"},
    {-5613, 5069,
     "e9eohCgihDfrfdfdhZfkgugZhjfhfhe3hGgRgNfLgffCfWeofTf8e+gTgWhSfkgMeMepfEgEhHgveggYeUf6c+gDfxge"
     "g+gjfVgbhUg9hnifg+g5hXgiguf8ftflfLfB"},
    {17302, -4092,
     "gXfXhHgogdfWgAfWfbfSe+e2fNfYglfQezf+eqfbfle+fIebexfTfOfkekgCe/gheUgHfvglg2hKh9hjhBgShIgmhVg1"
     "g9g0gshKgmgagPg3hGgvgWfV"},
    {-9468, 7710,
     "hvfgjFgAhWfffpfahzfqg/foiHf8iSf3ifgWjMgIiif5hrfbgXfWfBfmdrfqeAgMbhfxczf+degNb3ggfdg3f0gxecgs"
     "cxgMeMgfglgpjPf6"},
    {12638, 841,
     "gKe+gGfIfeekfbhmfRfOgge2fkfReKg6fkhJgegvfBgvfhfXfQgEe3fIfvgdgnhVg/gcg3glgjfThMgbgQgthHgDf6hN"
     "hRfRgJfNgHfb"},
    {5753, 7072,
     "fFf3a6gNflgtdLgafyg3hmgVf8g3jHhVekgMjvhYflgtjgg1lKhAlNgTirgljDgNhFfYe9fhaefPbOfQbKehdreedjeg"
     "gUeti/eu"},
    {-6845, -7096,
     "gMfTfufZflfbeKfyeQftd9gCgxgneKfyeRfye0gef6gphugnhEgMh0f8gdgzgGglf+hQg5gvhcgQg1fbgXfbgrfTghfV"
     "gcfS"},
    {-6775, -5385,
     "iCfEiMfnfTfOehf7fNgjfffYeqfheUgLe3geeXgPeCg4ebg1d2hwhSfriNe9iEfdg0gtgghFhcgphIf0gmfSgye1"},
    {10862, -678,
     "jAf2gWgqi5fPglfAiWfth7fFeOfaeRgoemf9eYgIejgSeMgme2gKfXfzdJgpfvgrekgIhFhfh5f6hRfZgqf5gNfc"},
    {15198, -548,
     "fMf4fwfkfJfofNfofLgAeugdfHgcgIgfhafyg3gHgPgwgOgDgKfLg5gHgcgjg4gjf1g7g8gCgUfwf+fIfefD"},
    {14365, 5075,
     "hkdPdtghfCdvhieaf9e6e0g8e+ezfuhUgLhhf0hsgXhLgFiGfFhjgJiIhdgufYgvgsgOgbe9giegf+eegpeb"},
    {-10821, 7620,
     "gnfdhZgQhpf8gRfPfEfQatfxcEfVdof9fzghjQgsY8f0d0gSiIhihfgckZfeiyfFiuf4dxhghcgkhnf1gifQ"},
    {-4515, -7805,
     "h7fVgrfDgMfVgEfNdlfhddfndEfocvfscTgGd9gigRgpjWgbhWgig+grguglg8gjhBgpgzgAiVgWiXfq"},
    {-8702, 7966,
     "h4fgd3fidIe1dOf5cxgMeVgpgBgkhPgbdKf/eRghfBguhGgshFgfhmgHfUgXjpgFiAfKiofrikfthPe+"},
    {-8516, 6566, "gSfUg0gPg6fmhtfehzfggJfRhJgIhIffenfgdkgYfIgtedfLdyfMfdg7d5f2hXgygMhOgjhchIf4"},
    {-1451, 6646, "fpe/hxe8d+ezbge8epfud9gObpgghigscmgxixgTf8gecugXhEhBiYgPibe8iYg3h+fjijg2imf5"},
    {1825, 7970, "lJe2cFfYfIe3epftfQeteHf8cpg9hbgkdqgcc9hVezhOkQgkg3fdiOgBgmgjiTgDh+fd"},
    {14540, -4079, "hgfdg3gOhOgTg8f6gHeJfefdf1ewfdgbe7e6frgGfDgDfChWfzhCfGhXgCguhCf3"},
    {-15554, 1908, "fxfwfngOgDgcfwgkgFgLgRgRf5gTgGgKgHf+gnfvgSf3gQfzgZfdf+f6fZfrfgfw"},
    {-12046, 7140, "b5fOfLgscZg1gigghOhThXhCeeg9lSgQiPfrj/f7hhfjhsfVeCfncLe6eEe6gAfW"},
    {14391, 4417, "hGfrhHgqgWeQdsfleoecdjhFfKeTeRf+fyhjgxhNhrgGgdiKgehOh1eYhNfe"},
    {-12351, 4851, "fOfydcgufhgjengjfugceZgTfag2gIgXhpfqg+fxhef1ghfegyfRhkfWgpfJ"},
    {12444, -1014, "eqfqf0gMgJgigrg9hjgogMgXhWgXhFgDgggNgmfzfbfleYfUesfke/e1"},
    {-10036, 7384, "h4friygNgafjejfQiXfVfuemdcfZeggJe7gmcHhNgCggjMf0eShBh2gw"},
    {5114, 8055, "d5fzemf4fyfweMfveTgYg5gfcigDjDgSiYgBgUflg6gYhegRiUfqfafx"},
    {15314, -450, "fhflftg7fpgnfSghfHgqe4gegcgYg2fkgifqgqfogofWgmfggMfM"},
    {12550, 1216, "gceRezgagCffgZfCfQfpf8hHfigFfwg8g7f5f/glfDhNhgf+gbfa"},
    {-5957, -8004, "fifNfjfTcvgOcgf6eDghgAgEfJgdjhf9jYf2hKgpg1gjhofX"},
    {-9898, -7193, "hufyhtgMg7fHeygIeGf8eFgEd5f6eagTfLgqg/gRh/fyiRf5"},
    {16712, -2216, "fafofJgbe4gtfAg1e+hGfygigrf/g4fegsfeggfkhSfCg0fS"},
    {12869, 113, "f6epfNgKfxfDgpfLfkf0fYg/fiiAgUhQghgkgHfKg8f3gJfX"},
    {-9850, 7672, "hMfSgEfMfSe2dbf2eVgQgCg6dcf4f5hOhsf9iXgiiMf6gIgN"},
    {12398, 1028, "fcfffhfBfhfifChFgVgbgZgcgLg+g3gGfwe9hKhgf2eh"},
    {13464, 3415, "gNfefHfDfXggfNfpfmfFe+gdgBgvg4g8g4f0gqgqhJfr"},
    {3458, 3567, "e8fWgIftgCf4eafXfPgNfpgogvgEgHgAgPgZhIf+hbge"},
    {-679, 5226, "dPfFdygPhRhofMhmiIhPhMguhUgEhrfDfKe7gRe4e0en"},
    {-17173, 6378, "g9ftg/gKhRfmhjfzf4f1e0fre0gVfagTeof6fogJgGgl"},
    {2545, 8041, "jEfddsfKbdf0bagRfugbdwgCeTguk1gciRfohlgej9fn"},
    {-15921, -7950, "dAfzd9gjfFgjf8gGfAgbg8gmi7fwhjfhhNfcgbfT"},
    {15588, -682, "fkf2fVgmfUhAfrhMgNgKgLfigefpgxfBgvfefyfk"},
    {-7690, 1787, "fifvfHgQfHglgMgWgqgHgXf9hEf3g0fogRfle6f+"},
    {2370, 3571, "g3fehOgGhKf4f+fvg2gMfzfidwf4gBgReGgTgTgr"},
    {1552, 3823, "fcexgPfhfrfNezgmfOgKd0gzgOg0h1f3hmgKhMgJ"},
    {-13271, 5404, "hggIfieOhXewfYgAfEgufbgufNgffugsgGgggvfz"},
    {-9565, 6911, "fCfdd5geevf1d3gthYgfhGgrhqfkg8fugeftg9fa"},
    {-7634, 7310, "gJfleVgDeVgCeSfyfkgGeRg1gFgkgwgHjlf1isfJ"},
    {-9320, 7277, "eVe1eOgEfChYgBgyg0gqhkgbjQf9i/fodreneIfs"},
    {-11620, 7765, "fyezezfdejf7dGfVdgfxd4gWiqhKjNhBiaf/iJgP"},
    {-10006, 7833, "gnfWddgLdbggchgEhhgeeHgYf5gmjEfykPfchMfR"},
    {9994, 7888, "cmf0bpgcdagnezhHd4gUkEhFjYgWjCfOjneffnem"},
    {-5855, -5110, "hQfTfifdd5fifTgjerfTfOgth4g8hVfng8go"},
    {-18000, -1656, "fAfofBfrfzglgygVgfgFg7gfgVgFfzfQf4f6"},
    {11790, -809, "gkflg+gIgZfVeMfse7fzfKgBgig5g3gBgbgk"},
    {8122, 620, "epfpfQhPfviQgtiihFfJgve5gweYfxeYfWfk"},
    {11034, 1868, "eqfQetgff+hWgxgthtgcg6f+gWfafUfUfpfG"},
    {921, 4121, "g8e5fyd8fSgGfYfffagaf8h5fpg5g3f7gygf"},
    {-12121, -7350, "iBfwh4gSfHfdeifmd1gIecgjgVgih4fu"},
    {7028, -4971, "dmf6f+g1gPgpgHgVhAfghffzgDfufkfS"},
    {17837, -1734, "gjfjfvfMfCfyfJgNf3gsgmgigtfzgZgR"},
    {12290, -809, "fyfIdpfkd7gMgAgkhPgVg/fihDgIhZgl"},
    {15988, -834, "gEfsexgrfKgkfaghgPgKgufohSfSgYfg"},
    {13047, -309, "gkezesgpetgJfHf5e7gEgXg3h8gEhufj"},
    {11850, 932, "d8ehgxhGhIg9g8hGg0hjgSeue+fJfLe8"},
    {12188, 1189, "g8fhhAgAf+fXfSfVfAfif9gvgHgzfwgv"},
    {-6559, 1823, "fmfne1gAfFf9f7gqgOgPhSgAgzf3gSfs"},
    {-15608, 2064, "fef5fvgVf1gIf/gHgKgIgjf3gbfwf3f0"},
    {-15765, 2132, "f6f6f5gCfdgDf0gXf8gEgagOgJf5gdff"},
    {12118, 2279, "fVeufLhUf1hLg6hihRhMgtfifvfDfEdg"},
    {-6366, 4655, "hIfzhdgCfOfXfcf6eBgqfngigmgfgjfP"},
    {-15301, 5712, "edfafMgZfxgvhbgkg1gPhDf5gqfhepfR"},
    {-7587, 6715, "eQf7fngxgrg4hcgOhOfkgBfVf0fye/fj"},
    {14509, 7556, "exe2aQgDdafoc6hBg1hFiEgTkIf7lqfL"},
    {-9583, 7806, "dsfrevgXfVgmf4gpiBf8g7f6h3fdflfc"},
    {16085, -987, "fZf9fDgLfrgPgGgohCfwghfrgQfm"},
    {-6094, 1011, "etf1fugJgdgcf+gng5gNgVf8f8e2"},
    {-7754, 2376, "fof7fng6fagcgWhAgef8gjetgAfG"},
    {-6181, 4911, "fQf+d+gfejgvgjgJiDfnhmfWgDfu"},
    {-7927, 6216, "fZfLfUgJfmgegEgHgngdgpf+gZfs"},
    {14360, 7321, "dpgAczgLfugFhfgoh9gJiOfZgMfm"},
    {-9361, 7498, "fJfZdvgIeHgag1gtiQgbhXfdglfg"},
    {2472, 7785, "chfYdQgXhEgZfEggjPgVgofaiQfp"},
    {-12556, -7348, "iZfZfFgEd/gJd3gchIgVhkfp"},
    {16711, -1493, "gQevflgNfrf6fygcf+hMgwfi"},
    {12071, -1024, "fWf+d8hGhdgUg1fhgjfif5fl"},
    {16168, -960, "fxfue2hWfrg8gigAgkewgofQ"},
    {15754, -735, "fsf7fUgWfXgpgFgRg8fWgoff"},
    {13473, -621, "fMe8f2hLgSgkgVgigXfigAfR"},
    {-15935, 2198, "f0f2ffgSgFgIgQgKgXf+gBfo"},
    {-7700, 2659, "fve5ftgNgCg0fTgogAgLhPfT"},
    {956, 4215, "ffezfTgUfohEgVglhAgmgReq"},
    {-16558, 5991, "fDfwe+gTfEgbhigRhPf3gKfa"},
    {-8190, 6271, "eLfJe6gCfqgbhKguiJf/f+ft"},
    {-18000, 7152, "gNgEhVgAiQfjf4fyeZfod9f6"},
    {15073, 7508, "eNfZdggJdGgngYghi6fxj7fl"},
    {-9384, 7752, "fTf9dEgHflgbjKf/hGftf0f1"},
    {-11019, 7770, "dGfjdsgghQggiTgKiNfxfefi"},
    {-10966, 7860, "eGftdagAgCgOhmgeg2f7iCfs"},
    {10508, 7831, "XMfZi2iDhTgMhLf5j9fHfjfY"},
    {16212, -1048, "gcfde6gBfag9g8fogUf9"},
    {12725, -346, "faffe7gSftgrhlgFgZff"},
    {12153, 1307, "fleqfVgxfNhNhWf8gjfc"},
    {-7782, 2658, "eTfwf5glgvgIhCf9gDfm"},
    {1269, 5561, "fEeveXg4fygqiTghggfO"},
    {-10450, 7342, "eoe+dkhGgigOiGgEhMfq"},
    {16785, -1647, "fffzfegsgEgbg/fG"},
    {-15676, 2118, "f9f1fKgDgIgMgxf8"},
    {18000, 7083, "eSf7fvggh/gq"},
};

int number_at(std::string_view steps, std::size_t at) {
  return static_cast<int>(64 * digits.find(steps[at]) + digits.find(steps[at + 1])) - 2048;
}

std::vector<LonLat> decoded(const Encoded& line) {
  int longitude = line.longitude;
  int latitude = line.latitude;
  std::vector<LonLat> points = {{longitude / 100.0, latitude / 100.0}};
  for (std::size_t at = 0; at < line.steps.size(); at += 4) {
    longitude += number_at(line.steps, at);
    latitude += number_at(line.steps, at + 2);
    points.push_back({longitude / 100.0, latitude / 100.0});
  }
  return points;
}

} // namespace

std::vector<std::vector<LonLat>> coastlines() {
  std::vector<std::vector<LonLat>> result;
  for (const Encoded& line : lines) {
    result.push_back(decoded(line));
  }
  return result;
}

} // namespace calotte::tools
