import "./page.css"; declare const TERRANE_LICENCES: {name: string}[]; console.log(TERRANE_LICENCES);
